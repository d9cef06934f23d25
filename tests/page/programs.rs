//! Programs on the page: dropped, followed from chart to line and back, kept when rejected, and
//! long ones.

use crate::browser::{DESKTOP, Key, Page, Result, THESIS, visit};
use crate::common::program::{opened_example, own_cutting};
use crate::common::{job_text, run};
use crate::{current, shows, stale, text};
use armill::verification::Programs;
use serde_json::{Value, json};

const SLOT: &str =
    "G21 G90\nS4000 M3\nG0 X600 Y-40 Z120\nG1 Z100 F1200\nY40 F900\nG2 X640 I20\nG1 Y-40\nG0 Z120\nM30";

/// Drops a file on the page.
async fn drop(page: &Page, name: &str, content: &str) -> Result {
    let script = format!(
        "const data = new DataTransfer(); data.items.add(new File([{}], {}, {{ type: 'text/plain' }})); \
         document.body.dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, bubbles: true, cancelable: true }}))",
        json!(content),
        json!(name)
    );
    page.js(&script).await?;
    Ok(())
}

/// The job of an opened program: the example's shaper goes with the example's path, and the program
/// stands in a stock up to `top` [mm].
fn job(kind: &str, text: &str, top: f64) -> Vec<(&'static str, Value)> {
    let mut changes = vec![
        ("path", json!({ "kind": kind, "text": text })),
        ("shaper", json!("none")),
        ("stock", json!({"kind": "extents", "top_mm": top})),
    ];
    changes.extend(own_cutting(text));
    changes
}

/// The selected line of the program, from 1, and its text.
async fn selected(page: &Page) -> Result<(u64, String)> {
    let found = page
        .js("const t = document.getElementById('path-text'); const upTo = t.value.slice(0, t.selectionStart); \
             return [upTo.split('\\n').length, t.value.slice(t.selectionStart, t.selectionEnd)]")
        .await?;
    Ok(serde_json::from_value(found)?)
}

#[test]
fn a_dropped_program_is_the_path() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.type_into("#motion-feed_mm_s", "50").await?;
        drop(page, "slot.nc", SLOT).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        let slot = [job("gcode", SLOT, 120.0).as_slice(), &[("motion.feed_mm_s", json!(50))]].concat();
        shows(page, &run(&slot)).await?;
        assert_eq!(page.value("#path-text").await?, SLOT, "as dropped");
        // The content determines the language, whatever the name; undo restores the previous
        // program.
        drop(page, "dome.txt", "UNITS/MM\nFEDRAT/1200,MMPM\nGOTO/600,0,100\nGOTO/640,0,100\nFINI").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'apt'", 20.0).await?;
        current(page).await?;
        drop(page, "points.csv", "x,y,z\n600,0,100\n640,0,100").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'csv'", 20.0).await?;
        current(page).await?;
        page.click("#undo").await?;
        page.click("#undo").await?;
        shows(page, &run(&slot)).await
    })
}

#[test]
fn a_chart_leads_to_its_line_and_back() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        drop(page, "slot.nc", SLOT).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        current(page).await?;
        page.click("#tab-overview").await?;
        page.wait_for("document.querySelector('#chart-before-after svg')", 20.0).await?;
        // From the line to the chart: the caret in line 7 moves the cursor to the start of its run.
        let lines = crate::common::column(&run(&job("gcode", SLOT, 120.0)), "program_line");
        let seventh = lines.iter().position(|line| *line == 7.0).ok_or("line 7 does not run")?;
        page.js("const t = document.getElementById('path-text'); const at = t.value.indexOf('G1 Y-40'); \
             t.focus(); t.setSelectionRange(at, at); t.click()")
            .await?;
        let cursor = page.with_module("page/cursor", "({ cursor }) => cursor()").await?;
        assert!((cursor.as_f64().unwrap_or(-1.0) - seventh as f64 * 1e-3).abs() < 1e-9, "{cursor}");
        page.wait_for("document.querySelector('#chart-before-after .readout').textContent.includes('line 7 of the program')", 10.0).await?;
        // From the chart to the line: the readout of the clicked place leads there.
        page.click("#chart-before-after .drawing").await?;
        let named = page.text("#chart-before-after .readout").await?;
        page.click("#chart-before-after .readout button").await?;
        let (line, chosen) = selected(page).await?;
        assert!(named.contains(&format!("line {line} of the program")), "{named}, not line {line}");
        assert_eq!(SLOT.lines().nth(line as usize - 1), Some(chosen.as_str()));
        assert_ne!(line, 7, "the middle of the run is elsewhere");
        Ok(())
    })
}

#[test]
fn a_rejected_program_stays_and_is_told_where() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        for (name, content, place) in [
            ("rotary.nc", SLOT.replace("G1 Y-40", "G1 Y-40 A30"), "line 7, column 9"),
            (
                "cycle.apt",
                "UNITS/MM\nGOTO/600,0,100\nCYCLE/DRILL,DEPTH,5\nGOTO/640,0,100".into(),
                "line 3, column 1",
            ),
            ("hole.csv", "x,y,z\n600,0,100\n640,,100".into(), "line 3, column 5"),
        ] {
            drop(page, name, &content).await?;
            page.wait_for(
                &format!("document.getElementById('path-text').value === {}", json!(content)),
                20.0,
            )
            .await?;
            stale(page).await?;
            let error = text(page, "path-text-error").await?.to_lowercase();
            assert!(error.contains(place), "{name}: {error}");
            assert_eq!(page.value("#path-text").await?, content, "nothing is lost");
            let shown = crate::number(page, "before-max").await?;
            assert_eq!(shown, run(&[]).summary().before_mm.both.max, "the last result stays");
        }
        Ok(())
    })
}

#[test]
fn a_long_program_is_shown_in_part_and_kept_whole() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let moves: String =
            (0..12_000).map(|i| format!("X{:.3} (finish)\n", 600.0 + f64::from(i) * 4e-3)).collect();
        let long = format!("G21 G90\nS4000 M3\nG0 X600 Y0 Z100\nG1 F6000\n{moves}M30");
        drop(page, "long.nc", &long).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        shows(page, &run(&job("gcode", &long, 110.0))).await?;
        let listing = text(page, "path-text-window").await?;
        assert!(listing.contains("1 G21 G90") && listing.len() < 1000, "{listing}");
        let note = page.text(".listing .note").await?;
        assert!(note.contains("long.nc: 12\u{202f}005 lines, 0.2 MB"), "{note}");
        // An edit elsewhere keeps the text; so does the saved job.
        page.type_into("#motion-feed_mm_s", "90").await?;
        shows(
            page,
            &run(&[job("gcode", &long, 110.0).as_slice(), &[("motion.feed_mm_s", json!(90))]].concat()),
        )
        .await?;
        page.click("#download-job").await?;
        let saved: Value = serde_json::from_str(&page.downloaded("long-job.json").await?)?;
        assert_eq!(saved["path"]["text"], json!(long));
        // From a line to the cursor and from a chart to the line, as with a short program.
        page.js("document.getElementById('path-text-window').scrollTop = 1e9").await?;
        page.wait_for("document.getElementById('path-text-window').textContent.includes('M30')", 5.0).await?;
        page.js("const rows = [...document.querySelectorAll('#path-text-window [data-line]')]; \
             rows.find(row => row.dataset.line === '12000').click()")
            .await?;
        let cursor = page.with_module("page/cursor", "({ cursor }) => cursor()").await?;
        assert!(cursor.as_f64().is_some_and(|time| time > 0.1), "{cursor}");
        page.click("#tab-overview").await?;
        page.wait_for("document.querySelector('#chart-before-after svg')", 20.0).await?;
        page.click("#chart-before-after .drawing").await?;
        page.wait_for("document.querySelector('#chart-before-after .readout button')", 20.0).await?;
        page.click("#chart-before-after .readout button").await?;
        let line = "document.querySelector('#path-text-window [aria-selected=true]')";
        page.wait_for(&format!("{line} && {line}.dataset.line !== '12000'"), 5.0).await?;
        let line = page.js(&format!("return {line}.dataset.line")).await?;
        let named = page.text("#chart-before-after .readout").await?;
        assert!(
            named.contains(&format!("line {} of the program", line.as_str().unwrap_or_default())),
            "{named}, {line}"
        );
        // A mistake far down is brought into view.
        drop(page, "long.nc", &long.replace("X630.000", "X630.000 A5")).await?;
        stale(page).await?;
        let error = text(page, "path-text-error").await?.to_lowercase();
        assert!(error.contains("line 7505, column 10"), "{error}");
        assert!(text(page, "path-text-window").await?.contains("7505 X630.000 A5"));
        // A short program is an editable text again.
        page.choose("#examples", "contour.nc").await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        current(page).await?;
        assert!(page.value("#path-text").await?.starts_with('%'));
        Ok(())
    })
}

/// The verdict is about joint commands, which keep the run's timing; a program's accuracy is stated
/// below it.
#[test]
fn what_a_program_is_worth_stands_under_the_verdict() -> Result {
    // A light cut by an arm that carries it, with numbers that were measured.
    let light = [
        ("robot", json!({"preset":"kuka-kr-210-2"})),
        ("workpiece_frame", json!({"xyz_mm":[1700,0,700]})),
        ("path", json!({"kind":"circle","center_mm":[0,0,0],"radius_mm":60,"normal":[0,0,1]})),
        ("motion", json!({"feed_mm_s":40,"sample_time_s":0.01})),
        ("material", json!({"preset":"al-7075-t6"})),
        ("cutting.axial_depth_mm", json!(1)),
        ("shaper", json!("none")),
        ("compensation.tolerance_mm", json!(0.05)),
        ("uncertainty", json!({"stiffness_percent":5,"cutting_percent":10})),
    ];
    let [thesis, carried] = [run(&[]), run(&light)].map(|report| Programs::default().package(&report, None));
    let (thesis, carried) = (thesis?, carried?);
    assert!(carried.met && !thesis.met, "{}", carried.sentence);
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let stated = "document.getElementById('as-program').textContent.startsWith('As a Staubli')";
        page.wait_for(stated, 20.0).await?;
        assert!(text(page, "as-program").await?.starts_with(&thesis.sentence));
        assert_eq!(page.js("return document.querySelectorAll('#as-program.bad').length").await?, json!(1));
        assert_eq!(
            page.js("return document.querySelector('#tolerance-met').dataset.state").await?,
            "cannot-run"
        );
        drop(page, "light.json", &job_text(&light)).await?;
        page.wait_for("document.querySelector('#tolerance-met').dataset.state === 'met'", 20.0).await?;
        page.wait_for("document.querySelector('#as-program:not(.bad)')", 20.0).await?;
        page.wait_for(&stated.replace("Staubli", "KUKA"), 20.0).await?;
        assert!(text(page, "as-program").await?.starts_with(&carried.sentence));
        Ok(())
    })
}

/// A program without a stock gets one; a job's own is kept, an example's goes with the example; where the
/// tool tilts, there is none.
#[test]
fn an_opened_program_brings_a_stock() -> Result {
    let own = json!({"kind":"box","from_mm":[500,-50,90],"to_mm":[700,50,101]});
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        drop(page, "slot.nc", SLOT).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        shows(page, &run(&job("gcode", SLOT, 120.0))).await?;
        assert_eq!(page.value("#stock-kind").await?, "extents");
        page.choose("#examples", "face.nc").await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        shows(page, &run(&opened_example("face.nc"))).await?;
        page.choose("#examples", "dome.apt").await?;
        page.wait_for("document.querySelector('#path-kind').value === 'apt'", 20.0).await?;
        current(page).await?;
        assert_eq!(page.value("#stock-kind").await?, "none");
        // One's own stays, whatever program comes.
        drop(page, "own.json", &job_text(&[("stock", own.clone()), ("shaper", json!("none"))])).await?;
        page.wait_for("document.querySelector('#stock-kind').value === 'box'", 20.0).await?;
        current(page).await?;
        drop(page, "slot.nc", SLOT).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        let mut kept = job("gcode", SLOT, 120.0);
        kept[2].1 = own;
        shows(page, &run(&kept)).await?;
        assert!(text(page, "still-asked").await?.contains("Stock"));
        // A stock that the program never touches is said, and cured by a button.
        let far = json!({"kind":"box","from_mm":[-500,-50,90],"to_mm":[-300,50,101]});
        drop(page, "far.json", &job_text(&[("stock", far), ("shaper", json!("none"))])).await?;
        page.wait_for("document.querySelector('#stock-from_mm-x').value === '-500'", 20.0).await?;
        current(page).await?;
        drop(page, "slot.nc", SLOT).await?;
        page.wait_for("document.querySelector('#verdict').textContent.startsWith('Nothing is cut')", 20.0)
            .await?;
        page.click("#remedy-first").await?;
        shows(page, &run(&job("gcode", SLOT, 120.0))).await?;
        // A program pasted over all of the text is opened as well.
        page.js("const t = document.getElementById('path-text'); t.focus(); t.select(); \
             const data = new DataTransfer(); \
             data.setData('text/plain', 'UNITS/MM\\nFEDRAT/1200,MMPM\\n' + 'GOTO/600,0,100\\nGOTO/640,0,100\\nFINI'); \
             t.dispatchEvent(new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }))")
            .await?;
        page.wait_for("document.querySelector('#path-kind').value === 'apt'", 20.0).await?;
        current(page).await
    })
}

/// What a dragged file does: its kind of event, and what the frame over the page is afterwards.
const DRAGGED: &str = "const data = new DataTransfer(); \
    data.items.add(new File(['1'], 'part.step')); \
    const over = (kind, on, more) => { const event = new DragEvent(kind, \
      { dataTransfer: data, bubbles: true, cancelable: true, ...more }); \
      document.querySelector(on).dispatchEvent(event); \
      const frame = document.getElementById('drop-zone'); \
      return frame.checkVisibility() ? frame.textContent : '' };";

/// A frame says what a drop would do while files are over the page, and only then; nothing moves for it.
#[test]
fn a_dragged_file_is_awaited_and_one_of_another_kind_refused() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let drag = async |what: &str| page.js(&format!("{DRAGGED} return {what}")).await;
        // What is hidden may still be filled.
        let places = "return [...document.querySelectorAll('main *')].filter(each => each.checkVisibility()) \
                      .map(each => each.getBoundingClientRect().top)";
        let before = page.js(places).await?;
        assert_eq!(drag("over('dragleave', 'body', {})").await?, "");
        for dark in [false, true] {
            page.prefer_dark(dark).await?;
            assert_eq!(drag("over('dragover', '#verdict', {})").await?, "Drop a program or a job");
            page.screenshot(&format!("drop-{dark}.png")).await?;
        }
        page.prefer_dark(false).await?;
        assert_eq!(page.js(places).await?, before, "nothing moves");
        // It takes no events, or the next dragover would be its own, and is silent.
        let frame = page
            .js("const frame = document.getElementById('drop-zone'); \
                 return [getComputedStyle(frame).pointerEvents, Boolean(frame.closest('[aria-hidden=true]'))]")
            .await?;
        assert_eq!(frame, json!(["none", true]));
        // From one element to the next it stays; out of the window it goes.
        let to_next = "over('dragleave', '#verdict', { relatedTarget: document.body })";
        assert_eq!(drag(to_next).await?, "Drop a program or a job");
        assert_eq!(drag("over('dragleave', '#verdict', {})").await?, "");
        assert_ne!(drag("over('dragover', '#verdict', {})").await?, "");
        page.press(Key::Escape).await?;
        assert_eq!(page.js("return document.getElementById('drop-zone').hidden").await?, true);
        // Where measurements are taken it says so, and a text that is dragged is left alone.
        assert_eq!(
            drag("over('dragover', '#identify [data-drop] textarea', {})").await?,
            "Drop measurements (CSV)"
        );
        assert_eq!(drag("over('drop', '#identify [data-drop] textarea', {})").await?, "");
        assert_eq!(drag("over('dragover', '#verdict', { dataTransfer: new DataTransfer() })").await?, "");
        // A model is no program: it says so, and the job stays as it was.
        assert_ne!(drag("over('dragover', '#verdict', {})").await?, "");
        assert_eq!(drag("over('drop', '#verdict', {})").await?, "");
        page.wait_for(
            "document.querySelector('#alert').textContent.includes('“part.step” was not opened')",
            10.0,
        )
        .await?;
        assert!(text(page, "alert").await?.contains("G-code, APT and CL files, points as CSV"));
        assert_eq!(page.value("#path-kind").await?, "circle");
        // Where programs are opened, and at the first screen's top, it is said before anything is dragged.
        page.js("document.getElementById('group-path').open = true").await?;
        for css in [".program-tools .drop-here", "#inputs-body > .drop-hint"] {
            let seen = format!("return document.querySelector('{css}').checkVisibility()");
            assert_eq!(page.js(&seen).await?, true, "{css}");
        }
        Ok(())
    })
}

/// A program whose zero is in the robot's foot: nothing fails, so no remedy says so, but one click in the list
/// of what is still asked about places the part where the core proposes.
#[test]
fn a_part_in_the_robot_s_foot_is_placed_in_front_by_one_click() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        drop(page, "slot.nc", SLOT).await?;
        page.wait_for("document.querySelector('#path-kind').value === 'gcode'", 20.0).await?;
        current(page).await?;
        let before = job("gcode", SLOT, 120.0);
        let proposed = armill::placement::in_front(&armill::Job::from_json(&job_text(&before))?)?;
        page.click("#place-asked").await?;
        shows(page, &run(&[before, vec![("workpiece_frame", json!({ "xyz_mm": proposed }))]].concat()))
            .await?;
        let listed = "return document.getElementById('still-asked').textContent";
        let listed = page.js(listed).await?;
        let listed = listed.as_str().unwrap_or_default();
        assert!(listed.contains("Tool frame") && !listed.contains("Part’s place"), "{listed}");
        let focus = "return document.activeElement.parentElement.id";
        assert_eq!(page.js(focus).await?, "group-frames", "the focus does not vanish with the button");
        page.click("#undo").await?;
        shows(page, &run(&job("gcode", SLOT, 120.0))).await
    })
}
