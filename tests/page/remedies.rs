//! What cures a warning is a button beside it, and undo takes it back.

use crate::browser::{DESKTOP, Result, THESIS, visit};
use crate::common::job_text;
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
