//! The tasks that people come with, done on the page as they would, with their clicks and fields
//! counted. What keyboards, screen readers and hostile input need is in other files.

use armill::chart::charts_of;
use armill::{Job, Progress};
use serde_json::{Value, json};

use crate::browser::{DESKTOP, PHONE, Page, Result, visit};
use crate::common::program::folder;
use crate::common::run;
use crate::{current, number, shows, text};

/// What a person does on the page.
pub struct Person<'a> {
    page: &'a Page,
    /// Clicks and fields so far.
    pub done: usize,
}

impl<'a> Person<'a> {
    /// Somebody who has just opened the page.
    pub fn at(page: &'a Page) -> Person<'a> {
        Person { page, done: 0 }
    }

    async fn click(&mut self, css: &str) -> Result {
        self.done += 1;
        self.page.click(css).await
    }

    async fn fill(&mut self, css: &str, value: &str) -> Result {
        self.done += 1;
        self.page.type_into(css, value).await
    }

    async fn choose(&mut self, css: &str, value: &str) -> Result {
        self.done += 1;
        self.page.choose(css, value).await
    }

    /// Drops a program on the page, and waits until the page asks about what it does not say.
    async fn drops(&mut self, name: &str, program: &str) -> Result {
        self.done += 1;
        self.page
            .js(&format!(
                "const data = new DataTransfer(); data.items.add(new File([{}], '{name}', {{ type: 'text/plain' }})); \
                 document.body.dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }}))",
                json!(program)
            ))
            .await?;
        self.page.wait_for("document.querySelectorAll('#still-asked li').length > 0", 20.0).await
    }

    /// What cannot run has a button that cures it.
    async fn takes_remedies(&mut self) -> Result {
        let page = self.page;
        for _ in 0..2 {
            let settled = "['current', 'stale'].includes(document.querySelector('#results').dataset.state)";
            page.wait_for(settled, 30.0).await?;
            let alert =
                page.js("return document.querySelector('#alert button')?.checkVisibility() ?? false").await?;
            if alert == true {
                self.click("#alert button").await?;
            } else if verdict(page).await? == "cannot-run" {
                self.click("#remedy-first").await?;
            }
        }
        current(page).await
    }
}

/// The verdict's state.
async fn verdict(page: &Page) -> Result<Value> {
    page.js("return document.querySelector('#tolerance-met').dataset.state").await
}

/// A programmer's way from a pocket to the package for a cell with base 3 and tool 5.
///
/// # Errors
/// If the page does not lead there.
pub async fn from_a_pocket_to_a_package(person: &mut Person<'_>) -> Result {
    let page = person.page;
    current(page).await?;
    person.drops("pocket.nc", &std::fs::read_to_string(folder().join("pocket.nc"))?).await?;
    person.click("#group-robot summary").await?;
    person.choose("#robot-preset", "kuka-kr-210-r2700-2").await?;
    person.click("#group-program summary").await?;
    person.fill("#program-base_number", "3").await?;
    person.fill("#program-tool_number", "5").await?;
    person.takes_remedies().await?;
    person.click("#confirm-asked").await?;
    current(page).await?;
    assert_ne!(verdict(page).await?, "cannot-run", "{}", text(page, "verdict").await?);
    // The cut is this program's: not the air beside the stock of the job before.
    assert!(number(page, "before-max").await? > 0.02, "{}", text(page, "verdict").await?);
    person.click("#download-program").await?;
    let archive = page.downloaded_bytes("POCKET.zip").await?;
    let held = String::from_utf8_lossy(&archive);
    for part in ["DEF POCKET", "BASE_DATA[3]", "TOOL_DATA[5]", "PTP", "LIN"] {
        assert!(held.contains(part), "{part}");
    }
    Ok(())
}

#[test]
fn a_programmer_gets_from_a_pocket_to_a_kuka_package() -> Result {
    visit("/", DESKTOP, async |page| {
        let mut person = Person::at(page);
        from_a_pocket_to_a_package(&mut person).await?;
        assert!(person.done <= 12, "{} clicks and fields", person.done);
        Ok(())
    })
}

/// A shop's program as a CAM system writes it: 2,849 lines, with homing in its header and footer.
fn of_the_shop() -> String {
    let mut lines: Vec<String> = [
        "%",
        "O1001 (PLATE)",
        "N10 G90 G94 G17 G49 G40 G80",
        "N15 G21",
        "N20 G28 G91 Z0.",
        "N25 G90",
        "(ADAPTIVE)",
        "N30 T1 M6",
        "N35 S6000 M3",
        "N40 G54",
        "N45 G0 X10. Y10.",
        "N50 G43 Z15. H1",
    ]
    .map(String::from)
    .to_vec();
    // Rows over a plate, as dense as CAM writes a spline.
    let rest = 2849 - lines.len() - 6;
    for k in 0..rest {
        let (row, step) = (k / 100, k % 100);
        let along = if row % 2 == 0 { step } else { 99 - step };
        let share = along as f64 / 99.0;
        let height = -1.0 - 2.0 * share * (1.0 - share);
        let feed = if k == 0 { " F1500." } else { "" };
        lines.push(format!(
            "N{} G1 X{:.3} Y{:.3} Z{height:.3}{feed}",
            60 + 5 * k,
            10.0 + 1.2 * along as f64,
            10.0 + 4.0 * row as f64
        ));
    }
    lines.extend(
        ["N99000 G0 Z15.", "N99005 M5", "N99010 G28 G91 Z0.", "N99015 G28 X0. Y0.", "M30", "%"]
            .map(String::from),
    );
    assert_eq!(lines.len(), 2849);
    lines.join("\n")
}

#[test]
fn a_programmers_own_program_is_taken_as_the_cam_system_wrote_it() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let mut person = Person::at(page);
        person.drops("plate.nc", &of_the_shop()).await?;
        // Its zero is the corner of the part, which is in the robot's foot until it has a place.
        person.takes_remedies().await?;
        assert!(person.done <= 3, "{} clicks", person.done);
        assert!(
            text(page, "understood").await?.contains("2849 lines"),
            "{}",
            text(page, "understood").await?
        );
        assert!(text(page, "understood").await?.contains("G28"), "the homing is named");
        assert_ne!(verdict(page).await?, "cannot-run", "{}", text(page, "verdict").await?);
        assert!(number(page, "before-max").await? > 0.02, "{}", text(page, "verdict").await?);
        Ok(())
    })
}

#[test]
fn whether_a_tolerance_is_realistic_is_said_before_anything_is_asked() -> Result {
    let report = armill::run(&Job::opening()?, &mut Progress::none())?;
    let summary = report.summary();
    visit("/", DESKTOP, async |page| {
        shows(page, &report).await?;
        let shown = page.js("return document.querySelector('#expected-p95').checkVisibility()").await?;
        assert_eq!(shown, true);
        assert!(number(page, "expected-p95").await? > 10.0 * summary.after_mm.max, "no promise of rounding");
        assert_eq!(verdict(page).await?, serde_json::to_value(summary.verdict_state)?);
        // And what to measure first, with what that would bring.
        assert!(!text(page, "measure-first").await?.is_empty());
        Ok(())
    })
}

#[test]
fn a_doctoral_student_takes_a_figure_of_the_thesis() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let mut person = Person::at(page);
        person.click("#tab-thesis").await?;
        person.click("#open-thesis").await?;
        let report = run(&[]);
        shows(page, &report).await?;
        let charts = charts_of(&report);
        let chart = charts.iter().find(|chart| chart.figure.contains("5.17")).ok_or("no figure 5.17")?;
        person.done += 1;
        page.js("[...document.querySelectorAll('#figures-index a')].find(each => each.textContent.includes('5.17')).click()")
            .await?;
        let place = format!("#chart-{}", chart.name);
        page.wait_for(&format!("document.querySelector('{place} svg .series')"), 20.0).await?;
        // The view has its formulas, with the equation of each.
        let panel = format!("document.querySelector('{place}').closest('[role=tabpanel]')");
        let sources = format!("return {panel}.querySelectorAll('.how math').length");
        assert!(page.js(&sources).await?.as_u64() > Some(0), "{place}");
        person.click(&format!("{place} [aria-label='Save the chart']")).await?;
        person.click(&format!("{place} .menu:not([hidden]) button:nth-child(1)")).await?;
        let drawing = page.downloaded(&format!("armill-{}.svg", chart.name)).await?;
        assert!(drawing.starts_with("<svg") || drawing.starts_with("<?xml"), "{drawing:.60}");
        assert!(person.done <= 5, "{} clicks", person.done);
        Ok(())
    })
}

#[test]
fn a_process_engineer_finds_a_place_for_the_part() -> Result {
    visit("/", DESKTOP, async |page| {
        current(page).await?;
        let before = number(page, "expected-p95").await?;
        let place = page.value("#workpiece_frame-xyz_mm-x").await?;
        let mut person = Person::at(page);
        person.click("#tab-placement").await?;
        page.wait_for("document.querySelector('#placement-best')?.disabled === false", 60.0).await?;
        person.click("#placement-best").await?;
        page.wait_for(
            &format!("document.querySelector('#workpiece_frame-xyz_mm-x').value !== '{place}'"),
            10.0,
        )
        .await?;
        current(page).await?;
        let after = number(page, "expected-p95").await?;
        assert!(after < before, "{before} to {after} mm");
        assert_eq!(person.done, 2);
        // From there the page offers no other place, which would be worse.
        let says = "document.querySelector('#placement-verdict').textContent.startsWith('No place on this map is better')";
        page.wait_for(says, 60.0).await?;
        assert_eq!(page.js("return document.querySelector('#placement-best').disabled").await?, true);
        Ok(())
    })
}

#[test]
fn on_a_phone_cause_and_effect_are_seen_together() -> Result {
    visit("/", PHONE, async |page| {
        current(page).await?;
        let before = number(page, "expected-p95").await?;
        let mut person = Person::at(page);
        person.click("#inputs-toggle").await?;
        // The program states its own spindle speed, and the page says so.
        let note = text(page, "cutting-spindle_rpm-note").await?;
        assert!(note.starts_with("The program states 12000 1/min, which is used"), "{note}");
        // Three flutes push more than two.
        person.click("#group-tool summary").await?;
        person.fill("#tool-flutes", "3").await?;
        let more = format!("Number(document.querySelector('#expected-p95').dataset.value) > {before}");
        page.wait_for(&more, 30.0).await?;
        current(page).await?;
        let seen = page
            .js("return ['#expected-p95', '#tool-flutes'].map(css => { \
                 const { top, bottom } = document.querySelector(css).getBoundingClientRect(); \
                 return top >= 0 && bottom <= innerHeight })")
            .await?;
        assert_eq!(seen, json!([true, true]));
        assert!(person.done <= 3, "{} clicks and fields", person.done);
        Ok(())
    })
}
