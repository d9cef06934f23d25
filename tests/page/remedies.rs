//! What cures a warning is a button beside it, and undo takes it back.

use crate::browser::{DESKTOP, PHONE, Result, THESIS, visit};
use crate::common::{job_text, refused};
use crate::current;
use crate::hostile::drop_file;
use serde_json::json;

#[test]
fn a_remedy_is_applied_by_its_button_and_undone() -> Result {
    // A spindle across the flange, for which joint 5 has no room unless the tool is turned.
    let job = job_text(&[
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1700,0,700]})),
        ("tool_frame", json!({"xyz_mm":[150,0,300],"rpy_deg":[0,90,0]})),
        ("path", json!({"kind":"line","from_mm":[-50,0,0],"to_mm":[50,0,0]})),
        ("cutting.axial_depth_mm", json!(2)),
        ("shaper", json!("none")),
    ]);
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        drop_file(page, "across.json", &json!([job]).to_string()).await?;
        let limit = "document.querySelector('#warnings-list li[data-code=joint-limit]')";
        page.wait_for(&format!("{limit}?.querySelector('button.remedy')"), 20.0).await?;
        current(page).await?;
        let said = page.js(&format!("return {limit}.textContent")).await?;
        assert!(said.as_str().is_some_and(|text| text.starts_with("Cannot run: joint 5")), "{said}");
        page.js("document.querySelector('#warnings').open = true").await?;
        page.click("#warnings-list li[data-code=joint-limit] button.remedy").await?;
        page.wait_for(&format!("!{limit}"), 20.0).await?;
        assert_ne!(page.value("#spin-angle_deg").await?, "0");
        page.js("document.querySelector('#undo').click()").await?;
        page.wait_for(&format!("{limit} && document.querySelector('#spin-angle_deg').value === '0'"), 20.0)
            .await?;
        Ok(())
    })
}

/// A sample time too short for a long run comes with the least that is enough, as a button.
#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn too_many_samples_have_a_button_with_the_sample_time_that_is_enough() -> Result {
    let refused = refused(&[("motion.feed_mm_s", json!(0.01))]);
    let least = serde_json::to_value(&refused)?["min"].as_f64().ok_or("no limit")?;
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "0.01").await?;
        page.wait_for("document.querySelector('#alert button')?.textContent.startsWith('Use ')", 20.0)
            .await?;
        assert!(page.text("#alert").await?.contains("samples, but at most"));
        assert_eq!(page.text("#alert button").await?, format!("Use {least} s"));
        page.click("#alert button").await?;
        assert_eq!(page.value("#motion-sample_time_s").await?.parse::<f64>()?, least);
        // It is accepted: two million samples would take long, so they are not waited for.
        let accepted = "document.querySelector('#results').dataset.state === 'computing' \
                        && !document.querySelector('#alert').textContent";
        page.wait_for(accepted, 5.0).await?;
        page.js("return new Promise(done => setTimeout(done, 1000))").await?;
        page.wait_for(accepted, 1.0).await?;
        page.click("#undo").await?;
        page.click("#undo").await?;
        current(page).await
    })
}

/// On a phone the cure of the worst warning is beside the verdict, whole and large enough for a finger, and the
/// head is as high as without one.
#[test]
fn on_a_phone_the_first_remedy_is_beside_the_verdict() -> Result {
    visit(THESIS, PHONE, async |page| {
        let touch = json!({ "enabled": true, "maxTouchPoints": 2 });
        page.devtools("Emulation.setTouchEmulationEnabled", touch).await?;
        current(page).await?;
        let top = "return document.querySelector('.picture').getBoundingClientRect().top";
        let with = page.js(top).await?;
        let button = page
            .js("const button = document.querySelector('#remedy-first'); \
                 const box = button.getBoundingClientRect(), numbers = document.querySelector('.numbers'); \
                 return [button.checkVisibility(), box.height >= 44, box.bottom <= innerHeight, \
                         button.scrollHeight <= button.clientHeight, button.scrollWidth <= button.clientWidth, \
                         box.right <= innerWidth, box.top >= numbers.getBoundingClientRect().bottom]")
            .await?;
        assert_eq!(button, json!([true, true, true, true, true, true, true]));
        page.screenshot("remedy-phone.png").await?;
        page.js("document.querySelector('#remedy-first').hidden = true").await?;
        assert_eq!(page.js(top).await?, with, "the head is as high without it");
        page.js("document.querySelector('#remedy-first').hidden = false").await?;
        page.click("#remedy-first").await?;
        page.wait_for("document.querySelector('#workpiece_frame-xyz_mm-x').value !== '0'", 20.0).await?;
        current(page).await
    })
}
