//! Inputs as people have them: numbers with units and sums, in mm or inch, frames as a brand counts
//! them, robots by search, a job with a name.

use crate::browser::{DESKTOP, Key, Page, Result, THESIS, visit};
use crate::common::run;
use crate::hostile::drop_file;
use crate::{current, shows, stale, text, unfold};
use armill::export::orientation::{about_moving_xyz, quaternion};
use armill::math::Pose;
use nalgebra::Vector3;
use serde_json::{Value, json};

/// What the field of `input` says it has understood.
async fn understood(page: &Page, input: &str) -> Result<String> {
    let said = page
        .js(&format!(
            "return document.querySelector('{input}').closest('.field').querySelector('.understood').textContent"
        ))
        .await?;
    Ok(said.as_str().unwrap_or_default().to_owned())
}

/// The job that the page has.
async fn job(page: &Page) -> Result<Value> {
    page.js("dispatchEvent(new Event('pagehide')); \
             return JSON.parse(sessionStorage.getItem('armill-inputs')).state.job")
        .await
}

/// Chooses a unit in the settings.
async fn set(page: &Page, setting: &str) -> Result {
    page.js(&format!("document.querySelector('#setting-{setting}').click()")).await.map(|_| ())
}

#[test]
fn numbers_take_units_and_sums_and_a_doubtful_comma_is_asked_about() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        for (typed, said, feed) in [
            ("4800 mm/min", "= 80 mm/s", 80.0),
            ("2*(30+5)", "= 70 mm/s", 70.0),
            ("1 1/2 in/s", "= 38.1 mm/s", 38.1),
            ("62,5", "= 62.5 mm/s", 62.5),
            ("90", "", 90.0),
        ] {
            page.type_into("#motion-feed_mm_s", typed).await?;
            shows(page, &run(&[("motion.feed_mm_s", json!(feed))])).await?;
            assert_eq!(understood(page, "#motion-feed_mm_s").await?, said, "{typed}");
        }
        // Once it is left, an expression is its number.
        page.type_into("#motion-feed_mm_s", "160/2").await?;
        page.press(char::from(Key::Tab)).await?;
        assert_eq!(page.value("#motion-feed_mm_s").await?, "80");

        // One thousand, or one? Each answer is a button.
        for (answer, value) in [(1, 1000.0), (2, 1.0)] {
            page.type_into("#motion-acceleration_mm_s2", "1,000").await?;
            stale(page).await?;
            let error = "#motion-acceleration_mm_s2-error";
            assert!(page.text(error).await?.contains("Did you mean 1000 or 1.000?"));
            assert!(text(page, "alert").await?.contains("Did you mean 1000 or 1.000?"));
            page.click(&format!("{error} button:nth-of-type({answer})")).await?;
            shows(
                page,
                &run(&[("motion.feed_mm_s", json!(80)), ("motion.acceleration_mm_s2", json!(value))]),
            )
            .await?;
            assert_eq!(text(page, &error[1..]).await?, "");
        }

        // A unit of another kind is refused with those that fit.
        page.type_into("#motion-acceleration_mm_s2", "5 N").await?;
        stale(page).await?;
        let error = text(page, "motion-acceleration_mm_s2-error").await?;
        assert!(error.contains("“5 N” is a force") && error.contains("in mm/s², m/s² or in/s²"), "{error}");
        page.type_into("#motion-acceleration_mm_s2", "0.2 m/s²").await?;

        // In vectors and tables as well.
        page.type_into("#path-center_mm-x", "1 in").await?;
        shows(page, &run(&[("motion.feed_mm_s", json!(80)), ("path.center_mm", json!([25.4, 0, 0]))]))
            .await?;
        page.choose("#path-kind", "polyline").await?;
        page.type_into("#path-points_mm", "60 cm, -200, 4 in\n700 0 100\n600; 200; 100").await?;
        current(page).await?;
        assert_eq!(
            job(page).await?["path"]["points_mm"],
            json!([[600, -200, 101.6], [700, 0, 100], [600, 200, 100]])
        );
        page.type_into("#path-points_mm", "1,000 5\n700 0 100").await?;
        stale(page).await?;
        assert!(text(page, "path-points_mm-error").await?.contains("Line 1: commas or spaces"));
        Ok(())
    })
}

#[test]
fn inches_are_shown_and_typed_and_the_job_stays_what_it_is() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        // Numbers that no short text in inches has.
        page.type_into("#path-radius_mm", "251.7").await?;
        page.type_into("#path-center_mm-y", "33.3").await?;
        let before = run(&[("path.radius_mm", json!(251.7)), ("path.center_mm", json!([0, 33.3, 0]))]);
        shows(page, &before).await?;
        let held = job(page).await?;
        set(page, "length-inch").await?;
        set(page, "feed-minute").await?;
        // 251.7 / 25.4 and 100 * 60 / 25.4, to seven digits.
        assert_eq!(page.value("#path-radius_mm").await?, "9.909449");
        assert_eq!(page.value("#motion-feed_mm_s").await?, "236.2205");
        assert!(text(page, "path-radius_mm-label").await?.ends_with(" in"));
        assert!(text(page, "motion-feed_mm_s-label").await?.ends_with(" in/min"));
        // The default of 300 mm, and 10000 mm at most.
        let help = text(page, "path-radius_mm-help").await?;
        assert!(help.contains("393.7008, default 11.81102 in."), "{help}");
        assert_eq!(job(page).await?, held, "looking at it changes nothing");
        // An edit writes what was edited, and its neighbours keep every bit.
        page.type_into("#path-center_mm-x", "0.5").await?;
        current(page).await?;
        assert_eq!(job(page).await?["path"]["center_mm"], json!([12.7, 33.3, 0]));
        page.type_into("#path-radius_mm", "254 mm").await?;
        current(page).await?;
        assert_eq!(understood(page, "#path-radius_mm").await?, "= 10 in");
        page.type_into("#motion-feed_mm_s", "240").await?;
        shows(
            page,
            &run(&[
                ("path.radius_mm", json!(254)),
                ("path.center_mm", json!([12.7, 33.3, 0])),
                ("motion.feed_mm_s", json!(101.6)),
            ]),
        )
        .await?;
        // What is out of range says so in the same unit.
        page.type_into("#path-radius_mm", "1000").await?;
        stale(page).await?;
        let error = text(page, "path-radius_mm-error").await?;
        assert!(
            error.starts_with("Radius is 1000 in; it must be") && error.contains("to 393.7008 in"),
            "{error}"
        );
        page.click("#undo").await?;
        current(page).await?;
        set(page, "length-mm").await?;
        set(page, "feed-second").await?;
        assert_eq!(page.value("#path-radius_mm").await?, "254");
        assert_eq!(page.value("#path-center_mm-y").await?, "33.3");
        assert_eq!(page.value("#motion-feed_mm_s").await?, "101.6");
        // Undo goes through it all, whatever unit it was typed in.
        unfold(page, "motion").await?;
        for _ in 0..3 {
            page.click("#undo").await?;
        }
        shows(page, &before).await
    })
}

#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn a_robot_is_found_by_what_is_known_of_it() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "robot").await?;
        let offered = "return [...document.querySelectorAll('#robot-preset-list [role=option]')].map(option => option.textContent)";
        let find = async |query: &str| -> Result<Vec<String>> {
            page.type_into("#robot-preset-search", query).await?;
            Ok(serde_json::from_value(page.js(offered).await?)?)
        };
        let robots = armill::job::presets::presets().robots;
        for (query, fits) in [
            ("60 kg", robots.iter().filter(|robot| robot.payload_kg == 60.0).count()),
            (
                "measured",
                robots.iter().filter(|robot| !robot.stiffness_assumed && robot.id.contains("240")).count(),
            ),
            ("guessed", robots.iter().filter(|robot| robot.stiffness_assumed).count()),
        ] {
            let names = find(query).await?;
            assert!(
                names.len() == fits && names.iter().all(|name| name.contains(query)),
                "{query}: {names:?}"
            );
        }
        assert_eq!(find("no such arm").await?, [""; 0]);
        assert!(page.text(".search-list .none").await?.contains("None"));
        // Until one is taken, nothing changes, and leaving shows what is chosen.
        page.press(char::from(Key::Escape)).await?;
        assert_eq!(page.value("#robot-preset-search").await?, "Stäubli RX-90");
        shows(page, &run(&[])).await?;
        // Its lengths: 330 + 1150 + the root of 115² + 1220², in mm.
        assert!(find("kr210 r2700-2").await?[0].contains("reach 2.71 m"));
        page.press(char::from(Key::Enter)).await?;
        assert_eq!(page.value("#robot-preset").await?, "kuka-kr-210-r2700-2");
        assert_eq!(page.value("#robot-preset-search").await?, "KUKA KR 210 R2700-2");
        shows(page, &run(&[("robot", json!({"preset": "kuka-kr-210-r2700-2"})), ("shaper", json!("none"))]))
            .await?;
        // By arrows, from the chosen one on; headings are the makers.
        page.press(char::from(Key::Down)).await?;
        let headings = page
            .js("return [...document.querySelectorAll('#robot-preset-list [role=group]')].map(group => group.ariaLabel)")
            .await?;
        assert_eq!(headings, json!(["Stäubli", "KUKA", "ABB", "Yaskawa", "FANUC", "My own numbers"]));
        page.press(format!("{}{}", Key::Up, Key::Down)).await?;
        page.press(char::from(Key::Enter)).await?;
        assert_eq!(page.value("#robot-preset").await?, "kuka-kr-210-r2700-2");
        // No name is cut off: what is longer than the box stands below it in full.
        unfold(page, "material").await?;
        for material in armill::job::presets::presets().materials {
            page.choose("#material-preset", material.id).await?;
            let whole = page
                .js("const box = document.querySelector('#material-preset-search'); \
                     return box.scrollWidth <= box.clientWidth || \
                     box.closest('.search-list').querySelector('.chosen').textContent.includes(box.value)")
                .await?;
            assert_eq!(whole, json!(true), "{}", material.name);
        }
        Ok(())
    })
}

#[test]
fn a_job_has_a_name_in_files_and_titles() -> Result {
    let slot = "G21 G90\nS4000 M3\nG0 X600 Y-60 Z120\nG1 Z100 F1200\nG1 Y60\nG0 Z120\nM30\n";
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        assert_eq!(page.value("#job-name").await?, "");
        drop_file(page, "slot 4.nc", &json!([slot]).to_string()).await?;
        page.wait_for("document.querySelector('#job-name').value === 'slot 4'", 20.0).await?;
        current(page).await?;
        assert_eq!(page.js("return document.title").await?, json!("slot 4 – Armill"));
        assert!(page.text(".listing .note").await?.contains("slot 4.nc"), "short as the program is");
        assert_eq!(page.value("#program-name").await?, "SLOT_4");
        page.click("#download-job").await?;
        let saved: Value = serde_json::from_str(&page.downloaded("slot-4-job.json").await?)?;
        assert_eq!(saved["name"], "slot 4");
        // It is an input as any other: typed, undone, shared, kept.
        page.type_into("#job-name", "plate <b>").await?;
        page.press(char::from(Key::Tab)).await?;
        page.wait_for("document.title.startsWith('plate <b>')", 10.0).await?;
        current(page).await?;
        assert_eq!(page.value("#program-name").await?, "PLATE_B");
        page.click("#download-columns").await?;
        assert!(page.downloaded("plate-b-columns.csv").await?.starts_with("time_s,"));
        page.click("#share").await?;
        page.js("document.querySelector('#share-markdown').click()").await?;
        page.wait_for(
            "document.querySelector('#share-text').value.startsWith('## plate \\\\<b\\\\>\\n')",
            10.0,
        )
        .await?;
        page.click("#share-close").await?;
        page.click("#undo").await?;
        assert_eq!(page.value("#job-name").await?, "slot 4");
        page.wait_for("JSON.parse(localStorage.getItem('armill-inputs'))?.state.job.name === 'slot 4'", 10.0)
            .await?;
        page.reload().await?;
        current(page).await?;
        assert_eq!(page.value("#job-name").await?, "slot 4");
        page.js("document.getElementById('open-thesis').click()").await?;
        assert_eq!(page.value("#job-name").await?, "");
        assert!(
            page.js("return document.title").await?.as_str().is_some_and(|title| title.starts_with("Armill"))
        );
        Ok(())
    })
}

#[test]
fn a_slider_pushes_its_number() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let slider = "document.querySelector('#motion-feed_mm_s').closest('.field').querySelector('.slider')";
        // 100 of 1 to 1000 is two thirds of the way on a logarithmic scale.
        let place = page.js(&format!("return {slider}.value / {slider}.max")).await?;
        assert!((place.as_f64().unwrap_or(0.0) - 2.0 / 3.0).abs() < 0.003, "{place}");
        page.js(&format!(
            "for (const value of [0.6, 0.55, 0.5]) {{ {slider}.value = value * {slider}.max; \
             {slider}.dispatchEvent(new Event('input', {{ bubbles: true }})) }}"
        ))
        .await?;
        // Half of the way is the geometric mean, 31.6, to two digits.
        assert_eq!(page.value("#motion-feed_mm_s").await?, "32");
        shows(page, &run(&[("motion.feed_mm_s", json!(32))])).await?;
        page.click("#undo").await?;
        shows(page, &run(&[])).await?;
        // It follows what is typed, and stays at its end beyond.
        for (typed, at) in [("10", 1.0 / 3.0), ("1500", 1.0), ("0.5", 0.0)] {
            page.type_into("#motion-feed_mm_s", typed).await?;
            let place = page.js(&format!("return {slider}.value / {slider}.max")).await?;
            assert!((place.as_f64().unwrap_or(-1.0) - at).abs() < 0.003, "{typed}: {place}");
        }
        Ok(())
    })
}

/// Pastes a text into a box.
async fn paste(page: &Page, css: &str, text: &str) -> Result {
    page.js(&format!(
        "const data = new DataTransfer(); data.setData('text/plain', {}); \
         document.querySelector('{css}').dispatchEvent(new ClipboardEvent('paste', \
         {{ clipboardData: data, bubbles: true, cancelable: true }}))",
        json!(text)
    ))
    .await
    .map(|_| ())
}

#[test]
fn frames_are_written_as_the_brand_counts_them() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        unfold(page, "frames").await?;
        unfold(page, "program").await?;
        // The page's conversions are the core's.
        for rpy in [[10.0, 20.0, 30.0], [-170.0, 45.0, 100.0], [5.0, -80.0, -120.0]] {
            let rotation = Pose::from_xyz_rpy(Vector3::zeros(), rpy.map(f64::to_radians)).rotation;
            let turned = about_moving_xyz(&rotation).map(f64::to_degrees);
            let quaternion = quaternion(&rotation);
            let made = page
                .with_module(
                    "form/orientation",
                    &format!("({{ CONVENTIONS }}) => ['Stäubli', 'ABB'].map((brand) => CONVENTIONS[brand].of({rpy:?}))"),
                )
                .await?;
            let made: Vec<Vec<f64>> = serde_json::from_value(made)?;
            let sign = quaternion[0].signum();
            // The page rounds to ten decimals.
            for (page, core) in
                made[0].iter().zip(turned).chain(made[1].iter().zip(quaternion.map(|q| sign * q)))
            {
                assert!((page - core).abs() < 1e-9, "{rpy:?}: {made:?}");
            }
        }
        let names = "return [...document.querySelectorAll('#tool_frame-rpy_deg .vector:not([hidden]) span')].map(name => name.textContent)";
        for (robot, shown) in [
            ("kuka-kr-210-r2700-2", json!(["A", "B", "C"])),
            ("abb-irb-6700-200-2-60", json!(["q1", "q2", "q3", "q4"])),
            ("fanuc-r-2000ic-165f", json!(["W", "P", "R"])),
            ("opw", json!(["roll", "pitch", "yaw"])),
            ("staubli-rx90", json!(["Rx", "Ry", "Rz"])),
        ] {
            let robot = page
                .js(&format!(
                    "const options = [...document.querySelector('#robot-preset').options].map(({{ value }}) => value); \
                     return options.find((value) => value === '{robot}') ?? options.find((value) => value.startsWith('{}'))",
                    &robot[..3]
                ))
                .await?;
            page.choose("#robot-preset", robot.as_str().unwrap_or_default()).await?;
            assert_eq!(page.js(names).await?, shown);
        }
        page.choose("#robot-preset", "kuka-kr-210-r2700-2").await?;
        // A whole frame is pasted into any of its boxes, in one step, and is the same in any language.
        paste(page, "#tool_frame-xyz_mm-y", "{X 250, Y 0, Z 200, A 10, B 90, C 0}").await?;
        assert_eq!(
            job(page).await?["tool_frame"],
            json!({ "xyz_mm": [250, 0, 200], "rpy_deg": [0, 90, 10] })
        );
        assert_eq!(page.value("#tool_frame-rpy_deg-yaw").await?, "10");
        page.click("#undo").await?;
        assert_eq!(job(page).await?["tool_frame"], json!({ "xyz_mm": [0, 0, 0], "rpy_deg": [0, 0, 0] }));
        paste(page, "#workpiece_frame-rpy_deg-pitch", "X: 900.0 Y: 0.0 Z: -5.5 W: 1.0 P: 2.0 R: 3.0").await?;
        assert_eq!(
            job(page).await?["workpiece_frame"],
            json!({ "xyz_mm": [900, 0, -5.5], "rpy_deg": [1, 2, 3] })
        );
        // The first of KUKA's boxes is its A, the yaw of the job.
        page.type_into("#workpiece_frame-rpy_deg .vector:not([hidden]) .part:first-child input", "30")
            .await?;
        assert_eq!(job(page).await?["workpiece_frame"]["rpy_deg"], json!([1, 2, 30]));
        // How a spindle sits: one choice.
        page.choose("#tool_frame-rpy_deg-spindle", "minus-x").await?;
        assert_eq!(job(page).await?["tool_frame"]["rpy_deg"], json!([0, -90, 0]));
        assert_eq!(page.value("#tool_frame-rpy_deg-pitch").await?, "-90");
        // A quaternion is no rotation until its parts belong together.
        page.choose("#program-controller", "abb").await?;
        page.type_into("#tool_frame-rpy_deg-q1", "1").await?;
        stale(page).await?;
        assert!(text(page, "tool_frame-rpy_deg-error").await?.contains("a rotation needs 1"));
        page.type_into("#tool_frame-rpy_deg-q3", "0").await?;
        page.wait_for("document.querySelector('#tool_frame-rpy_deg-error').textContent === ''", 10.0).await?;
        assert_eq!(job(page).await?["tool_frame"]["rpy_deg"], json!([0, 0, 0]));
        Ok(())
    })
}
