//! The times in Chromium, in the cores that the site ships and in one made of the benchmark's own stages. `cargo xtask bench` starts the
//! server and the driver and tells where they are; the result is a JSON file.
#![allow(clippy::print_stdout, reason = "a command-line tool speaks on its standard output")]

use std::error::Error;
use std::time::Duration;
use std::{env, fs};

use armill_bench::stages::job;
use fantoccini::wd::{Capabilities, TimeoutConfiguration};
use fantoccini::{Client, ClientBuilder};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use tokio::runtime::Runtime;

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// How the browser is started; the page tests read the same file.
const CAPABILITIES: &str = include_str!("../../.cargo/webdriver.json");

/// Longest that one question may take; a million samples of every stage take minutes on a slow machine.
const PATIENCE: Duration = Duration::from_secs(1200);

/// How often the page is opened again, and the pause between.
const WARM_VISITS: usize = 15;
const PAUSE: Duration = Duration::from_secs(1);

fn main() -> Outcome {
    let file = env::var("ARMILL_BENCH_RESULT")?;
    let sizes: Vec<usize> =
        env::var("ARMILL_BENCH_SAMPLES")?.split(',').map(str::parse).collect::<Result<_, _>>()?;
    let times = Runtime::new()?.block_on(measured(&sizes))?;
    Ok(fs::write(file, serde_json::to_string_pretty(&times)?)?)
}

async fn measured(sizes: &[usize]) -> Outcome<Value> {
    let capabilities: Capabilities = serde_json::from_str(CAPABILITIES)?;
    let client = ClientBuilder::new(HttpConnector::new())
        .capabilities(capabilities)
        .connect(&env::var("ARMILL_WEBDRIVER_URL")?)
        .await?;
    let outcome = all(&client, sizes).await;
    client.close().await?;
    outcome
}

async fn all(client: &Client, sizes: &[usize]) -> Outcome<Value> {
    let wait = TimeoutConfiguration::new(Some(PATIENCE), None, None);
    client.update_timeouts(wait).await?;
    let site = env::var("ARMILL_SITE_URL")?;
    println!("Chromium: first result");
    let first = first_results(client, &site).await?;
    client.goto(&format!("{site}bench/index.html")).await?;
    println!("Chromium: kinematics");
    let mut result = json!({ "kinematics": ask(client, &[json!("kinematics")]).await?, "jobs": {} });
    result["first_result"] = json!(first);
    for &samples in sizes {
        println!("Chromium: {samples} samples");
        result["jobs"][samples.to_string()] = json!({
            "stages": ask(client, &[json!("stages"), json!(samples)]).await?,
            "small": ask(client, &[json!("whole"), json!("small"), json!(job(samples))]).await?,
            "full": ask(client, &[json!("whole"), json!("full"), json!(job(samples))]).await?,
        });
    }
    let agent = client.execute("return navigator.userAgent", Vec::new()).await?;
    result["browser"] = agent;
    Ok(result)
}

/// From opening the page to its first result [ms]: the first time with nothing cached, then again and again.
async fn first_results(client: &Client, site: &str) -> Outcome<Vec<Value>> {
    let script = "const [done] = arguments; \
                  const look = () => { \
                    const [mark] = performance.getEntriesByName('first result'); \
                    mark ? done(mark.startTime) : setTimeout(look, 50); \
                  }; \
                  look();";
    let mut times = Vec::new();
    for visit in 0..=WARM_VISITS {
        client.goto(&format!("{site}index.html?visit={visit}")).await?;
        times.push(client.execute_async(script, Vec::new()).await?);
        // The compiled code goes into the browser's cache, and the full core comes, after that.
        tokio::time::sleep(PAUSE).await;
    }
    Ok(times)
}

/// Asks a Worker of its own, so that each starts with fresh memory.
async fn ask(client: &Client, question: &[Value]) -> Outcome<Value> {
    let script = "const [question, done] = arguments; \
                  const worker = new Worker('worker.js', { type: 'module' }); \
                  const end = (answer) => (worker.terminate(), done(answer)); \
                  worker.onmessage = ({ data }) => end(data); \
                  worker.onerror = ({ message }) => end({ error: message }); \
                  worker.postMessage(question);";
    let mut answer = client.execute_async(script, vec![json!(question)]).await?;
    match answer.get("error") {
        Some(error) => Err(format!("{question:?}: {error}").into()),
        None => Ok(answer["value"].take()),
    }
}
