//! axe-core finds nothing, of whatever severity, on any state of the page, in light and dark.

use std::path::Path;

use serde_json::json;

use crate::browser::{DESKTOP, Key, PHONE, Page, Result, THESIS, setting, visit};
use crate::{current, stale, standalone, unfold};

/// axe-core's findings in a part of the page, by all its rules or those of this name: rule, place and
/// reason, one per line.
async fn faults(page: &Page, part: &str, only: Option<&str>) -> Result<Vec<String>> {
    if page.js("return window.axe === undefined").await? == true {
        let source = Path::new(&setting("ARMILL_NPM_TOOLS")?).join("axe-core/axe.min.js");
        page.js(&std::fs::read_to_string(source)?).await?;
    }
    let part = json!(part);
    let only = only.map_or(String::new(), |rule| format!("runOnly: ['{rule}']"));
    // Elements that fade are checked after they have finished.
    page.js("return Promise.all(document.getAnimations().map(each => each.finished.catch(() => {})))")
        .await?;
    let found = page
        .js(&format!(
            "return axe.run({part}, {{ resultTypes: ['violations'], {only} }}).then(({{ violations }}) => violations
               .flatMap(({{ id, nodes }}) => nodes.map(({{ target, failureSummary }}) => \
                   `${{id}}: ${{target.flat().join(' ')}}: ${{failureSummary.replaceAll('\\n', ' ')}}`)))"
        ))
        .await?;
    Ok(serde_json::from_value(found)?)
}

/// Checks the whole page, and notes the findings under the state's name.
async fn look(page: &Page, state: &str, notes: &mut Vec<String>) -> Result {
    look_at(page, "html", state, notes).await
}

/// Checks a part of the page in light, and its contrast in dark too: nothing else depends on colours.
async fn look_at(page: &Page, part: &str, state: &str, notes: &mut Vec<String>) -> Result {
    for (dark, colours, only) in [(false, "light", None), (true, "dark", Some("color-contrast"))] {
        page.prefer_dark(dark).await?;
        let found = faults(page, part, only).await?;
        notes.extend(found.into_iter().map(|fault| format!("{state}, {colours}: {fault}")));
    }
    page.prefer_dark(false).await
}

/// Asserts that there are no findings.
fn none(notes: &[String]) -> Result {
    if notes.is_empty() { Ok(()) } else { Err(notes.join("\n").into()) }
}

/// Unfolds every group of inputs.
async fn unfold_all(page: &Page) -> Result {
    page.js("for (const group of document.querySelectorAll('details')) group.open = true").await.map(|_| ())
}

#[test]
fn every_view_is_accessible() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let mut notes = Vec::new();
        current(page).await?;
        let tabs = page.js("return [...document.querySelectorAll('[role=tab]')].map(tab => tab.id)").await?;
        let tabs: Vec<String> = serde_json::from_value(tabs)?;
        assert!(tabs.len() >= 8);
        for tab in tabs {
            page.js(&format!("document.getElementById('{tab}').click()")).await?;
            if tab == "tab-identify" {
                for part in ["loads", "response"] {
                    page.js(&format!("document.getElementById('identify-{part}-example').click()")).await?;
                }
                page.wait_for("document.querySelector('#chart-response svg.plot')", 20.0).await?;
            }
            let panel = tab.replace("tab-", "panel-");
            page.wait_for(
                &format!("document.querySelector('#{panel} :is(svg, canvas, tbody tr, .lead)')"),
                20.0,
            )
            .await?;
            // What is around the views is the same in each, and looked at below.
            look_at(page, &format!("#{panel}"), &tab, &mut notes).await?;
        }
        unfold_all(page).await?;
        look(page, "all inputs", &mut notes).await?;
        none(&notes)
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn every_answer_is_accessible() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let mut notes = Vec::new();
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "-5").await?;
        stale(page).await?;
        look(page, "invalid input", &mut notes).await?;
        page.type_into("#motion-feed_mm_s", "100").await?;
        current(page).await?;
        page.type_into("#path-radius_mm", "1500").await?;
        stale(page).await?;
        look(page, "out of reach", &mut notes).await?;
        unfold(page, "path").await?;
        page.choose("#examples", "pocket.nc").await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        current(page).await?;
        for group in ["stock", "cutting"] {
            unfold(page, group).await?;
        }
        page.view("forces").await?;
        page.wait_for("document.querySelector('#chart-removal svg .series')", 30.0).await?;
        look(page, "in a stock", &mut notes).await?;
        page.choose("#examples", "dome.apt").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'apt'", 20.0).await?;
        current(page).await?;
        page.view("path").await?;
        look(page, "program", &mut notes).await?;
        page.type_into("#path-text", "G41").await?;
        stale(page).await?;
        look(page, "program refused", &mut notes).await?;
        none(&notes)
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn every_dialog_is_accessible() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        let mut notes = Vec::new();
        current(page).await?;
        page.click("#open-settings").await?;
        page.wait_for("document.querySelector('#settings:popover-open')", 5.0).await?;
        look(page, "settings", &mut notes).await?;
        page.press(char::from(Key::Escape)).await?;
        page.click("#share").await?;
        page.wait_for("document.querySelector('#share-dialog[open]')", 5.0).await?;
        look(page, "share", &mut notes).await?;
        page.press(char::from(Key::Escape)).await?;
        page.click("#pin").await?;
        page.type_into("#motion-feed_mm_s", "50").await?;
        current(page).await?;
        look(page, "compared", &mut notes).await?;
        none(&notes)
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn a_phone_and_the_other_pages_are_accessible() -> Result {
    let mut notes = Vec::new();
    visit(THESIS, PHONE, async |page| {
        current(page).await?;
        look(page, "phone", &mut notes).await?;
        page.click("#inputs-toggle").await?;
        unfold_all(page).await?;
        look(page, "phone, inputs", &mut notes).await
    })?;
    visit("/embed.html#charts=before-after+actual-path", PHONE, async |page| {
        current(page).await?;
        look(page, "embed", &mut notes).await?;
        unfold_all(page).await?;
        page.type_into("#motion-feed_mm_s", "-5").await?;
        stale(page).await?;
        look(page, "embed, invalid input", &mut notes).await
    })?;
    visit(&standalone::address(), DESKTOP, async |page| {
        current(page).await?;
        look(page, "one file", &mut notes).await
    })?;
    none(&notes)
}
