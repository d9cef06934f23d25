//! Times in Chromium, in the core that the site ships and in one with the benchmark's own stages.
//! `cargo xtask bench` starts the server and the driver and passes their addresses; the result is a
//! JSON file.
#![allow(clippy::print_stdout, reason = "a command-line tool prints to standard output")]

use std::error::Error;
use std::time::Duration;
use std::{env, fs};

use armill_bench::adaptive;
use armill_bench::stages::job;
use fantoccini::actions::{InputSource, MOUSE_BUTTON_LEFT, MouseActions, PointerAction};
use fantoccini::wd::{Capabilities, TimeoutConfiguration};
use fantoccini::{Client, ClientBuilder};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use tokio::runtime::Runtime;

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// Browser capabilities, shared with the page tests.
const CAPABILITIES: &str = include_str!("../../.cargo/webdriver.json");

/// Time limit for one request; a million samples of every stage take minutes on a slow machine.
const PATIENCE: Duration = Duration::from_secs(1200);

/// Opens the page with the thesis's job, which is the default job; without this it opens the bracket.
const THESIS: &str = "#example=thesis";

/// How often the page is reloaded, and the pause in between.
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
            "whole": ask(client, &[json!("whole"), json!(job(samples))]).await?,
            "pocket": ask(client, &[json!("whole"), json!(adaptive::job(samples))]).await?,
        });
    }
    println!("Chromium: a number dragged");
    result["drag"] = dragged(client).await?;
    let agent = client.execute("return navigator.userAgent", Vec::new()).await?;
    result["browser"] = agent;
    Ok(result)
}

/// From opening the page to its first result [ms]: first with an empty cache, then repeatedly.
async fn first_results(client: &Client, site: &str) -> Outcome<Vec<Value>> {
    let script = "const [done] = arguments; \
                  const look = () => { \
                    const [mark] = performance.getEntriesByName('first result'); \
                    mark ? done(mark.startTime) : setTimeout(look, 50); \
                  }; \
                  look();";
    let mut times = Vec::new();
    for visit in 0..=WARM_VISITS {
        client.goto(&format!("{site}index.html?visit={visit}{THESIS}")).await?;
        times.push(client.execute_async(script, Vec::new()).await?);
        // From here on the compiled code is in the browser's cache.
        tokio::time::sleep(PAUSE).await;
    }
    Ok(times)
}

/// What a user sees while dragging a number of the default job to and fro for three seconds: how
/// many inputs, results, chart drawings and page paintings there are per second, and the longest
/// time between two paintings [ms].
async fn dragged(client: &Client) -> Outcome<Value> {
    client.set_window_size(1280, 800).await?;
    client.goto(&format!("{}{THESIS}", env::var("ARMILL_SITE_URL")?)).await?;
    let drawn = "return document.querySelectorAll('#panel-overview figure .series').length >= 3";
    while client.execute(drawn, Vec::new()).await? != json!(true) {
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    // The scene and other work deferred until the page is idle.
    tokio::time::sleep(Duration::from_secs(2)).await;
    let place = client
        .execute(
            "const label = document.getElementById('cutting-axial_depth_mm-label'); \
             label.closest('details').open = true; label.scrollIntoView({ block: 'center' }); \
             const count = (window.count = { inputs: 0, results: 0, charts: 0, frames: 0, longest: 0, start: performance.now() }); \
             label.closest('.field').addEventListener('input', () => count.inputs++); \
             const watch = (node, name) => new MutationObserver(() => count[name]++).observe(node, { childList: true }); \
             watch(document.getElementById('fingerprint'), 'results'); \
             watch(document.querySelector('.curve .drawing'), 'charts'); \
             let last; \
             requestAnimationFrame(function frame(now) { \
               count.frames++; count.longest = Math.max(count.longest, now - (last ?? now)); last = now; requestAnimationFrame(frame); \
             }); \
             const { x, y, height } = label.getBoundingClientRect(); return [Math.round(x) + 12, Math.round(y + height / 2)]",
            Vec::new(),
        )
        .await?;
    let [x, y]: [i64; 2] = serde_json::from_value(place)?;
    let to = |milliseconds, x| PointerAction::MoveTo {
        duration: Some(Duration::from_millis(milliseconds)),
        x: x as f64,
        y: y as f64,
    };
    let mut hand = MouseActions::new("mouse".to_owned())
        .then(to(0, x))
        .then(PointerAction::Down { button: MOUSE_BUTTON_LEFT });
    for step in 0..150 {
        let there = step % 40;
        hand = hand.then(to(20, x + 4 * if there < 20 { there } else { 40 - there }));
    }
    client.execute("count.start = performance.now()", Vec::new()).await?;
    client.perform_actions(hand.then(PointerAction::Up { button: MOUSE_BUTTON_LEFT })).await?;
    let rates = "const s = (performance.now() - count.start) / 1000; const a = (n) => n / s; \
                 return { inputs: a(count.inputs), results: a(count.results), charts: a(count.charts), \
                 frames: a(count.frames), longest_ms: count.longest }";
    Ok(client.execute(rates, Vec::new()).await?)
}

/// Runs each question in a new Worker, so that it starts with fresh memory.
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
