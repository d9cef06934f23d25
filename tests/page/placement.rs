//! The view "Placement": the map is the core's, a click moves the part, undo restores it.

use crate::browser::{DESKTOP, Result, THESIS, visit};
use crate::current;
use armill::Job;
use armill::placement::{PlacementMap, PlacementStatus};
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
        let cells = page
            .js("return [...document.querySelectorAll('#placement-table tbody \
                 tr')].reverse().flatMap(row => [...row.querySelectorAll('td')].map(cell => \
                 cell.textContent))")
            .await?;
        let survey = PlacementMap::new(&Job::default())?;
        let step = |from: f64, to: f64, n: usize| from + (to - from) * n as f64 / 10.0;
        let mut numbers = 0;
        for (n, cell) in cells.as_array().ok_or("no cells")?.iter().enumerate() {
            let at = [step(ranges[0], ranges[1], n % 11), step(ranges[2], ranges[3], n / 11), ranges[4]];
            let place = survey.at(Vector3::from(at) * 1e-3);
            let text = cell.as_str().unwrap_or_default();
            if place.status == PlacementStatus::Unreachable {
                assert_eq!(text, "–", "{at:?}");
                continue;
            }
            let shown: f64 = text.split(' ').next().unwrap_or_default().parse()?;
            assert!((shown - place.max * 1e3).abs() < 0.006 * shown, "{at:?}: {text} and {place:?}");
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
