//! The arm's load, its joint springs and its free tool spin, entered on the page.

use crate::browser::{DESKTOP, Result, THESIS, visit};
use crate::chart::{Chart, column};
use crate::common::run;
use crate::{current, shows, text, unfold};
use serde_json::json;

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn weight_and_worn_joints_are_entered_as_rows() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "robot").await?;
        page.type_into("#robot-loads_kg_mm", "6, 9, 20, 0, 120").await?;
        let loads = ("robot.loads_kg_mm", json!([[6, 9, 20, 0, 120]]));
        shows(page, &run(std::slice::from_ref(&loads))).await?;
        page.type_into("#robot-joint_springs_nm_arcmin", "2, 1, 0.5\n2, 300, 1.5").await?;
        let springs = ("robot.joint_springs_nm_arcmin", json!([[2, 1, 0.5], [2, 300, 1.5]]));
        shows(page, &run(&[loads, springs])).await?;

        // Falling torques are reported beside the rows, and the last result stays.
        let verdict = text(page, "verdict").await?;
        page.type_into("#robot-joint_springs_nm_arcmin", "2, 300, 0.5\n2, 1, 1.5").await?;
        page.wait_for(
            "document.querySelector('#robot-joint_springs_nm_arcmin-error')?.textContent.includes('torques of a joint must rise')",
            20.0,
        )
        .await?;
        assert_eq!(text(page, "verdict").await?, verdict);
        Ok(())
    })
}

#[test]
fn a_free_spin_says_what_it_gains() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "frames").await?;
        page.type_into("#tool_frame-rpy_deg-pitch", "45").await?;
        current(page).await?;
        page.choose("#spin-mode", "free").await?;
        let changes = [
            ("tool_frame.rpy_deg", json!([0, 45, 0])),
            ("spin", json!({"mode":"free","angle_deg":0,"range_deg":[-180,180],"goal":"smooth-joints"})),
        ];
        let report = run(&changes);
        shows(page, &report).await?;
        let summary = serde_json::to_value(report.summary()).unwrap();
        let said = text(page, "spin-gain").await?;
        assert!(said.contains(summary["spin"]["sentence"].as_str().unwrap()), "{said}");
        let chart = Chart::open(page, "joints", "spin").await?;
        for across in [0.1, 0.6] {
            chart.hover(across).await?;
            let values = chart.values().await?;
            let sample = column(&report, "time_s").iter().position(|t| *t == values[0]).unwrap();
            assert_eq!(values[1..], [column(&report, "spin_deg")[sample], 0.0]);
        }
        page.js("document.getElementById('tab-overview').click()").await?;
        page.choose("#spin-mode", "fixed").await?;
        current(page).await?;
        page.js("document.getElementById('tab-joints').click()").await?;
        page.wait_for("document.querySelector('#chart-joints svg.plot')", 10.0).await?;
        page.wait_for("!document.querySelector('#panel-joints #chart-spin')", 10.0).await?;
        page.js("document.getElementById('tab-overview').click()").await?;
        page.wait_for("!document.getElementById('spin-gain').checkVisibility()", 10.0).await
    })
}
