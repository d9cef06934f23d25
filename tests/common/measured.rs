//! What is learned, identified and compared from the examples of measurements: the same bits natively and in the browser.

use serde_json::Value;
use xxhash_rust::xxh3::Xxh3;

pub(crate) const PASS_JOB: &str = include_str!("../../web/examples/learn-pass.json");
pub(crate) const PASS: &str = include_str!("../../web/examples/learn-pass.csv");
pub(crate) const CUTS_JOB: &str = include_str!("../../web/examples/learn-cuts.json");
pub(crate) const CUTS: &str = include_str!("../../web/examples/learn-cuts.csv");
pub(crate) const ROBOT: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.json");
pub(crate) const LOADS: &str = include_str!("../../web/examples/identify-fanuc-r2000ic.csv");
pub(crate) const RESPONSE: &str = include_str!("../../web/examples/identify-response.csv");
pub(crate) const RUNS: [&str; 2] = [
    include_str!("../../web/examples/gear-kuka-kr300-a.csv"),
    include_str!("../../web/examples/gear-kuka-kr300-b.csv"),
];
/// A job with a loop; the rest is the default.
pub(crate) const LOOP: &str = r#"{"version":1,"online":{"measures":"position","noise":0.01,"resolution":0.005},
    "motion":{"sample_time_s":0.02},"uncertainty":{"draws":100}}"#;

/// Digests of what comes out, by name; tests/measured.rs and tests/web.rs assert the same ones.
pub(crate) const DIGESTS: [(&str, &str); 9] = [
    ("pass", "b0cd77e4fe051e73"),
    ("commands", "d6eff7e1a2e063c4"),
    ("cuts", "e7d90640b19e43ca"),
    ("stiffness", "e1ab5458ff21a075"),
    ("response", "5484d732dacab507"),
    ("gear", "2ac97ef7264d2925"),
    ("loads", "136fecff4ec295e2"),
    ("encoders", "5c09439bb8edaef9"),
    ("loop", "fe9613f1bc2127a5"),
];

/// Asserts a digest.
pub(crate) fn same(name: &str, value: &Value) {
    let (_, expected) = DIGESTS.iter().find(|(own, _)| *own == name).unwrap();
    assert_eq!(&digest(value), expected, "{name}");
}

/// A digest of all keys, words and bits of numbers of a value; what is null counts as absent, and -0 as 0.
fn digest(value: &Value) -> String {
    let mut hash = Xxh3::new();
    add(&mut hash, value);
    format!("{:016x}", hash.digest())
}

fn add(hash: &mut Xxh3, value: &Value) {
    match value {
        Value::Null => (),
        Value::Bool(flag) => hash.update(&[u8::from(*flag)]),
        Value::Number(number) => hash.update(&(number.as_f64().unwrap() + 0.0).to_bits().to_le_bytes()),
        Value::String(text) => hash.update(text.as_bytes()),
        Value::Array(values) => values.iter().for_each(|value| add(hash, value)),
        Value::Object(fields) => {
            for (key, value) in fields.iter().filter(|(_, value)| !value.is_null()) {
                hash.update(key.as_bytes());
                add(hash, value);
            }
        }
    }
}
