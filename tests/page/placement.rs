//! The view "Placement": the map is the core's, a click moves the part, undo restores it.

use crate::browser::{DESKTOP, Result, THESIS, visit};
use crate::current;
use armill::Job;
use armill::placement::{PlacementMap, PlacementStatus};
use armill::units::DEG;
use nalgebra::Vector3;
use serde_json::{Value, json};

const DONE: &str = "/places in/.test(document.querySelector('#placement-status').textContent)";

/// Opens the view on a map of 11 x 11 places.
async fn open(page: &crate::browser::Page) -> Result {
    current(page).await?;
    page.js("document.querySelector('#tab-placement').click()").await?;
    page.choose("#placement-steps", "11").await?;
    page.wait_for(
        &format!("{DONE} && document.querySelector('#placement-status').textContent.startsWith('121 ')"),
        60.0,
    )
    .await
}

#[test]
fn the_map_shows_what_the_core_says_of_each_place() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        page.js("document.querySelector('.placement-values').open = true").await?;
        page.wait_for("document.querySelectorAll('#placement-table tbody td').length === 121", 10.0).await?;
        let ranges = page
            .js("return ['a-from','a-to','b-from','b-to','at'].map(id => Number(document.querySelector('#placement-' + id).value))")
            .await?;
        let ranges: Vec<f64> =
            ranges.as_array().ok_or("no ranges")?.iter().filter_map(Value::as_f64).collect();
        // The table runs from the largest y down.
        let table = "return [...document.querySelectorAll('#placement-table tbody \
                     tr')].reverse().flatMap(row => [...row.querySelectorAll('td')].map(cell => \
                     cell.textContent))";
        let after = page.js(table).await?;
        page.choose("#placement-error", "max").await?;
        let before = page.js(table).await?;
        let survey = PlacementMap::new(&Job::default())?;
        let step = |from: f64, to: f64, n: usize| from + (to - from) * n as f64 / 10.0;
        let mut numbers = 0;
        let (before, after) = (before.as_array().ok_or("no cells")?, after.as_array().ok_or("no cells")?);
        for (n, (cell, after)) in before.iter().zip(after).enumerate() {
            let at = [step(ranges[0], ranges[1], n % 11), step(ranges[2], ranges[3], n / 11), ranges[4]];
            let place = survey.at(Vector3::from(at) * 1e-3);
            let text = cell.as_str().unwrap_or_default();
            if place.status == PlacementStatus::Unreachable {
                assert_eq!(text, "–", "{at:?}");
                continue;
            }
            if place.status == PlacementStatus::InBase {
                assert_eq!(text, "×", "{at:?}");
                continue;
            }
            let shown: f64 = text.split(' ').next().unwrap_or_default().parse()?;
            assert!((shown - place.max * 1e3).abs() < 0.006 * shown, "{at:?}: {text} and {place:?}");
            let left: f64 =
                after.as_str().unwrap_or_default().split(' ').next().unwrap_or_default().parse()?;
            assert!((left - place.p95 * 1e3).abs() < 0.006 * left, "{at:?}: {left} and {place:?}");
            let sign = ["", "·", "⁄"][place.status as usize];
            assert_eq!(text.split(' ').nth(1).unwrap_or_default(), sign, "{at:?}");
            numbers += 1;
        }
        assert!(numbers > 5, "{numbers} places are within reach");
        Ok(())
    })
}

#[test]
fn a_place_is_taken_by_click_or_key_and_given_back_by_undo() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        let place = "[...document.querySelectorAll('#workpiece_frame-xyz_mm input')].map(input => Number(input.value))";
        assert_eq!(page.js(&format!("return {place}")).await?, json!([0, 0, 0]));
        let verdict = |text: &str| {
            format!("document.querySelector('#placement-verdict').textContent.startsWith('{text}')")
        };
        page.wait_for(&verdict("Best on this map: x "), 5.0).await?;
        page.wait_for("!document.querySelector('#placement-best').disabled", 30.0).await?;
        page.js("document.querySelector('#placement-best').click()").await?;
        page.wait_for(&format!("{place}.some(value => value !== 0)"), 5.0).await?;
        current(page).await?;
        // The part is there now, as soon as the map knows what its place is worth.
        page.wait_for(&verdict("No place on this map is better"), 10.0).await?;
        page.js("document.querySelector('#undo').click()").await?;
        page.wait_for(&format!("{place}.every(value => value === 0)"), 5.0).await?;
        let press = |key: &str| {
            format!(
                "document.querySelector('#placement-map').dispatchEvent(new KeyboardEvent('keydown', \
                 {{ key: '{key}', bubbles: true, cancelable: true }}))"
            )
        };
        page.js(&press("ArrowRight")).await?;
        page.wait_for("/^x /.test(document.querySelector('#placement-read').textContent)", 5.0).await?;
        page.js(&press("Enter")).await?;
        page.wait_for(&format!("{place}[0] !== 0"), 5.0).await
    })
}

/// Base, floor and part are on the map, the best is on the side to stay on, and three heights are
/// compared in one table.
#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn the_map_shows_what_stands_around_and_compares_heights() -> Result {
    visit("/", DESKTOP, async |page| {
        open(page).await?;
        let words =
            "return [...document.querySelectorAll('#placement-map .around')].map(each => each.textContent)";
        assert_eq!(page.js(words).await?, json!(["base", "part"]));
        let verdict = "document.querySelector('#placement-verdict').textContent";
        page.wait_for(&format!("{verdict}.includes('in front of the base')"), 10.0).await?;
        page.choose("#placement-side", "behind").await?;
        page.wait_for(&format!("{verdict}.includes('behind the base')"), 5.0).await?;
        page.choose("#placement-side", "any").await?;
        page.wait_for(&format!("!{verdict}.includes('the base')"), 5.0).await?;
        page.choose("#placement-layers", "3").await?;
        page.wait_for(
            "document.querySelector('#placement-status').textContent.startsWith('363 places in')",
            90.0,
        )
        .await?;
        page.js("document.querySelector('.placement-values').open = true").await?;
        page.wait_for("document.querySelectorAll('#placement-table tbody').length === 3", 10.0).await?;
        assert_eq!(page.js("return document.querySelector('#placement-layer').options.length").await?, 3);
        page.wait_for(&format!("/, z [-0-9]+ mm/.test({verdict})"), 5.0).await?;
        // In an upright plane the floor is a line.
        page.choose("#placement-layers", "1").await?;
        page.choose("#placement-plane", "xz").await?;
        page.wait_for("document.querySelector('#placement-map .floor')", 30.0).await
    })
}

/// The best of 36 turns is that of the core, one click applies it, and undo gives the turn back.
#[test]
fn the_tool_is_turned_to_its_best_by_one_click() -> Result {
    visit("/", DESKTOP, async |page| {
        open(page).await?;
        let job = Job::opening()?;
        let (survey, was) = (PlacementMap::new(&job)?, job.spin.angle_deg);
        let place = Vector3::from(job.workpiece_frame.xyz_mm) * 1e-3;
        let at = |deg: f64| survey.turned(deg * DEG).at(place);
        let mut best: Option<(f64, f64)> = None;
        for deg in (0..36).map(|n| f64::from(n * 10 - 180)) {
            let place = at(deg);
            if place.status == PlacementStatus::Good && best.is_none_or(|(_, least)| place.p95 < least) {
                best = Some((deg, place.p95));
            }
        }
        let (deg, least) = best.ok_or("no turn keeps all limits")?;
        let now = at(was);
        assert!(now.status != PlacementStatus::Good || now.p95 > least, "the job has the best turn");
        page.js("document.querySelector('#placement-turn').click()").await?;
        let said = "document.querySelector('#placement-turned').textContent";
        page.wait_for(&format!("{said}.startsWith('The tool is turned from ')"), 30.0).await?;
        let spin = "Number(document.querySelector('#spin-angle_deg').value)";
        page.wait_for(&format!("{spin} === {deg}"), 5.0).await?;
        current(page).await?;
        page.js("document.querySelector('#undo').click()").await?;
        page.wait_for(&format!("{spin} === {was}"), 5.0).await
    })
}

#[test]
fn a_map_is_cancelled_and_computed_again() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        open(page).await?;
        page.choose("#placement-steps", "41").await?;
        let cancel = "document.querySelector('#placement-cancel')";
        page.wait_for(&format!("!{cancel}.disabled"), 10.0).await?;
        page.js(&format!("{cancel}.click()")).await?;
        let says = |text: &str| {
            format!("document.querySelector('#placement-status').textContent.includes('{text}')")
        };
        page.wait_for(&says("Cancelled"), 10.0).await?;
        page.wait_for(&format!("{cancel}.disabled"), 10.0).await?;
        // Nothing keeps running in the background, and another map starts with Workers of its own.
        page.choose("#placement-steps", "11").await?;
        page.wait_for(&says("121 places in"), 60.0).await?;
        current(page).await
    })
}
