//! A chart on the page, as used by the chart tests.

use crate::browser::{Page, Result};
use armill::Report;
use serde_json::{Value, json};

/// Keys of Chrome's input events.
pub(crate) const CONTROL: u32 = 2;

/// The numbers at the ticks below the plot of `chart`.
pub(crate) const TICKS: &str = "[...chart.querySelectorAll('svg.plot .axis text[text-anchor=middle]')].map(t => \
     Number(t.textContent.replace('\u{2212}', '-'))).filter(Number.isFinite)";

/// A chart on the page.
pub(crate) struct Chart<'a> {
    pub(crate) page: &'a Page,
    pub(crate) css: String,
}

impl<'a> Chart<'a> {
    /// The chart of a view, drawn and scrolled into sight.
    pub(crate) async fn open(page: &'a Page, view: &str, name: &str) -> Result<Self> {
        page.js(&format!("document.getElementById('tab-{view}').click()")).await?;
        let chart = Self { page, css: format!("#chart-{name}") };
        let drawn = format!(
            "[...document.querySelectorAll('#panel-{view} .chart-figure')].every(f => \
             f.querySelector('svg.plot')) && document.querySelector('{}')",
            chart.css
        );
        page.wait_for(&drawn, 30.0).await?;
        chart.show().await?;
        Ok(chart)
    }

    pub(crate) async fn show(&self) -> Result {
        let scroll = "scrollIntoView({ block: 'center', behavior: 'instant' })";
        self.page.js(&format!("document.querySelector('{}').{scroll}", self.css)).await.map(|_| ())
    }

    /// Runs a function body with `chart` as the figure.
    pub(crate) async fn js(&self, body: &str) -> Result<Value> {
        self.page.js(&format!("const chart = document.querySelector('{}'); {body}", self.css)).await
    }

    pub(crate) async fn wait_for(&self, condition: &str) -> Result {
        let there = format!(
            "(() => {{ const chart = document.querySelector('{}'); return {condition}; }})()",
            self.css
        );
        self.page.wait_for(&there, 10.0).await
    }

    /// A position on the page [px] by fractions of the plot, from left and from top.
    pub(crate) async fn at(&self, across: f64, down: f64) -> Result<(f64, f64)> {
        let plot = "chart.querySelector('svg.plot clipPath rect').getBBox()";
        let place = self
            .js(&format!(
                "const p = {plot}, d = chart.querySelector('.drawing').getBoundingClientRect(); \
                 return [d.left + p.x + 4 + {across} * (p.width - 8), d.top + p.y + 4 + {down} * \
                 (p.height - 8)]"
            ))
            .await?;
        Ok(serde_json::from_value(place)?)
    }

    pub(crate) async fn mouse(&self, kind: &str, (x, y): (f64, f64), more: Value) -> Result {
        let mut event = json!({ "type": kind, "x": x, "y": y });
        event.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.page.devtools("Input.dispatchMouseEvent", event).await.map(|_| ())
    }

    pub(crate) async fn hover(&self, across: f64) -> Result {
        self.mouse("mouseMoved", self.at(across, 0.5).await?, json!({})).await?;
        self.wait_for("chart.querySelector('.readout b')").await
    }

    pub(crate) async fn drag(&self, from: (f64, f64), to: (f64, f64)) -> Result {
        let (from, to) = (self.at(from.0, from.1).await?, self.at(to.0, to.1).await?);
        self.mouse("mousePressed", from, json!({ "button": "left", "buttons": 1, "clickCount": 1 })).await?;
        for step in 1..=4 {
            let share = f64::from(step) / 4.0;
            let place = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            self.mouse("mouseMoved", place, json!({ "button": "left", "buttons": 1 })).await?;
        }
        self.mouse("mouseReleased", to, json!({ "button": "left", "clickCount": 1 })).await
    }

    pub(crate) async fn double_click(&self) -> Result {
        let place = self.at(0.5, 0.5).await?;
        for count in [1, 2] {
            for kind in ["mousePressed", "mouseReleased"] {
                self.mouse(kind, place, json!({ "button": "left", "clickCount": count })).await?;
            }
        }
        Ok(())
    }

    /// Presses a button of the chart's tools.
    pub(crate) async fn tool(&self, label: &str) -> Result {
        self.js(&format!("chart.querySelector('[aria-label=\"{label}\"]').click()")).await.map(|_| ())
    }

    /// The full values that the readout shows: first the one along x.
    pub(crate) async fn values(&self) -> Result<Vec<f64>> {
        let values =
            self.js("return [...chart.querySelectorAll('.readout b')].map(b => b.dataset.value)").await?;
        let texts: Vec<String> = serde_json::from_value(values)?;
        Ok(texts.iter().map(|text| text.parse()).collect::<std::result::Result<_, _>>()?)
    }

    /// The numbers at the ticks below the plot.
    pub(crate) async fn ticks(&self) -> Result<Vec<f64>> {
        let ticks = self.js(&format!("return {TICKS}")).await?;
        Ok(serde_json::from_value(ticks)?)
    }
}

/// A column of a report.
pub(crate) fn column(report: &Report, key: &str) -> Vec<f64> {
    report.columns().into_iter().find(|column| column.key == key).unwrap().values
}
