//! Reading the page: units, colours, what is remembered; stable while it opens; explained; on
//! paper; without JavaScript.

use crate::browser::{DESKTOP, Key, PHONE, Result, THESIS, visit};
use crate::common::run;
use crate::{current, narrow, number, shows, text};
use serde_json::json;

#[test]
fn no_panel_is_wider_than_its_screen() -> Result {
    // The first is a small phone of 320 px beside the scroll bar of a desktop browser.
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let tabs = page.js("return [...document.querySelectorAll('[role=tab]')].map(tab => tab.id)").await?;
        let tabs: Vec<String> = serde_json::from_value(tabs)?;
        assert!(tabs.len() >= 10, "{tabs:?}");
        for tab in tabs {
            page.js(&format!("document.getElementById('{tab}').click()")).await?;
            page.js("for (const part of document.querySelectorAll('details')) part.open = true").await?;
            for width in [1280, 768, 390, 335] {
                page.resize((width, 844)).await?;
                narrow(page, &format!("{tab} at {width}")).await?;
            }
        }
        Ok(())
    })
}

#[test]
fn units_colours_and_open_panels_are_remembered() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        let background = "return getComputedStyle(document.body).backgroundColor";
        let light = page.js(background).await?;
        page.view("joints").await?;
        page.js("document.querySelector('#group-motion > summary').click(); \
             document.querySelector('#group-tool > summary').click()")
            .await?;
        page.click("#open-settings").await?;
        for choice in ["length-inch", "force-lbf", "theme-dark"] {
            page.click(&format!("#setting-{choice}")).await?;
        }
        let check = async || -> Result {
            let summary = run(&[]).summary();
            let read = async |id: &str| Ok::<f64, Box<dyn std::error::Error>>(text(page, id).await?.parse()?);
            let max = summary.before_mm.both.max / 25.4;
            assert!((read("before-max").await? - max).abs() < 5e-5, "three digits");
            assert!((read("both-max").await? - max).abs() < 5e-7, "to a millionth");
            let force = run(&[]).mean_force().norm() / 4.4482216152605;
            assert!((read("force").await? - force).abs() < 0.5);
            assert_eq!(
                number(page, "before-max").await?,
                summary.before_mm.both.max,
                "in full it stays in mm"
            );
            let units = page
                .js("return [...new Set([...document.querySelectorAll('[data-unit]')].map(unit => \
                 unit.textContent))].sort()")
                .await?;
            assert_eq!(units, json!(["in", "lbf"]));
            assert_eq!(text(page, "verdict").await?, summary.verdict);
            assert_ne!(page.js(background).await?, light);
            Ok(())
        };
        check().await?;
        page.reload().await?;
        shows(page, &run(&[])).await?;
        check().await?;
        let open = page.js("return ['motion', 'tool', 'path'].map(name => document.getElementById(`group-${name}`).open)").await?;
        assert_eq!(open, json!([false, true, true]));
        assert_eq!(page.js("return document.querySelector('#panel-joints').hidden").await?, false);
        // Light was chosen, so the system setting does not count.
        page.click("#open-settings").await?;
        page.click("#setting-theme-light").await?;
        page.prefer_dark(true).await?;
        assert_eq!(page.js(background).await?, light);
        page.click("#setting-theme-auto").await?;
        assert_ne!(page.js(background).await?, light);
        Ok(())
    })
}

/// What to expect has a place of its own, also while an error is shown.
#[test]
fn what_to_expect_covers_nothing() -> Result {
    for size in [DESKTOP, PHONE] {
        visit(THESIS, size, async |page| {
            let report = run(&[]);
            shows(page, &report).await?;
            assert_eq!(text(page, "expected").await?, report.how_sure().sentence);
            assert!(report.how_sure().sentence.starts_with("The arm cannot run this."));
            let apart = "const box = (id) => document.getElementById(id).getBoundingClientRect();
                const [top, middle, bottom] = ['verdict', 'expected', 'errors'].map(box);
                return middle.height > 0 && top.bottom <= middle.top && middle.bottom <= bottom.top;";
            assert_eq!(page.js(apart).await?, true, "{size:?}");
            Ok(())
        })?;
    }
    Ok(())
}

#[test]
fn nothing_moves_while_the_page_opens_and_typing_never_waits() -> Result {
    let watch = "localStorage.setItem('armill-settings', JSON.stringify({ length: 'inch', force: 'lbf', theme: 'dark' }));
        window.shifts = []; window.pictures = [];
        new PerformanceObserver((list) => window.shifts.push(...list.getEntries().map((entry) => entry.value)))\
          .observe({ type: 'layout-shift', buffered: true });
        addEventListener('keydown', ({ target }) => requestAnimationFrame(() => \
          window.pictures.push([target.value, document.getElementById('results').dataset.state])), true);";
    for size in [DESKTOP, PHONE] {
        visit(THESIS, size, async |page| {
            page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": watch })).await?;
            page.reload().await?;
            shows(page, &run(&[])).await?;
            page.wait_for("document.querySelector('#chart-before-after svg.plot')", 20.0).await?;
            page.js("return new Promise(done => setTimeout(done, 300))").await?;
            let shift = page.js("return window.shifts.reduce((sum, each) => sum + each, 0)").await?;
            // A tenth of what browsers call good.
            assert!(shift.as_f64().unwrap() < 0.01, "layout shift {shift} at {size:?}");
            if size == PHONE {
                return Ok(());
            }
            // Every key is painted while the runs it supersedes are under way: none waits for a
            // result.
            page.type_into("#motion-sample_time_s", "0.0005").await?;
            current(page).await?;
            page.js("window.pictures = []").await?;
            page.type_into("#motion-feed_mm_s", "123.456789").await?;
            current(page).await?;
            let pictures = page.js("return window.pictures").await?;
            let pictures = pictures.as_array().unwrap();
            assert!(pictures.len() >= 10, "{pictures:?}");
            assert_eq!(pictures[pictures.len() - 1], json!(["123.456789", "computing"]));
            Ok(())
        })?;
    }
    Ok(())
}

/// A view that is opened by its address, and the embedded calculator, reserve room for all that a result brings.
#[test]
#[ignore = "one of the slower ones: cargo xtask test --heavy"]
fn nothing_moves_where_the_budget_is_opened() -> Result {
    let watch = "window.shifts = []; \
        new PerformanceObserver((list) => window.shifts.push(...list.getEntries().map((entry) => entry.value)))\
          .observe({ type: 'layout-shift', buffered: true });";
    // From another page: only a new document runs the script.
    for (before, address, size) in [
        ("/embed.html", "/#view=budget", DESKTOP),
        ("/embed.html", "/#view=budget", PHONE),
        ("/", "/embed.html#show=budget", DESKTOP),
        ("/", "/embed.html#show=budget&inputs=none&charts=none", DESKTOP),
    ] {
        visit(before, size, async |page| {
            page.devtools("Page.addScriptToEvaluateOnNewDocument", json!({ "source": watch })).await?;
            page.goto(address).await?;
            page.wait_for("document.querySelectorAll('#budget-table tbody tr').length > 8", 30.0).await?;
            current(page).await?;
            page.js("return new Promise(done => setTimeout(done, 1000))").await?;
            let shift = page.js("return window.shifts.reduce((sum, each) => sum + each, 0)").await?;
            assert!(shift.as_f64().unwrap() < 0.01, "layout shift {shift} at {address}, {size:?}");
            Ok(())
        })?;
    }
    Ok(())
}

/// Counts what a screen reader would say: each time that a live region comes to hold another text.
const LISTEN: &str = "window.said = []; const live = '[aria-live]:not([aria-live=off]), [role=status], [role=alert]'; \
    new MutationObserver((changes) => { \
      const regions = new Set(changes.map(({ target }) => (target.closest ? target : target.parentElement)?.closest(live))); \
      for (const region of regions) if (region?.textContent.trim() && region.checkVisibility()) \
        window.said.push(region.textContent.trim()) \
    }).observe(document.body, { subtree: true, childList: true, characterData: true });";

/// Keys pressed in a row are answered once, with what has been settled on.
#[test]
fn settled_results_are_announced_once() -> Result {
    for address in ["/", THESIS] {
        visit(address, DESKTOP, async |page| {
            current(page).await?;
            page.wait_for("document.getElementById('announced').textContent", 20.0).await?;
            page.js(LISTEN).await?;
            for slid in [false, true] {
                // What a program is worth comes last, and late on a busy machine.
                page.wait_for("document.getElementById('as-program').textContent", 60.0).await?;
                page.js("return new Promise(done => setTimeout(done, 2000))").await?;
                page.js("document.getElementById('group-motion').open = true; window.said = []; \
                     document.querySelector('#motion-feed_mm_s').focus()")
                    .await?;
                let before = page.value("#motion-feed_mm_s").await?;
                if slid {
                    page.js("const slider = document.querySelector('.field:has(#motion-feed_mm_s) input[type=range]'); \
                         const slide = () => (slider.value -= 4, slider.dispatchEvent(new Event('input'))); \
                         return new Promise(done => [0, 1, 2, 3, 4].forEach(k => \
                           setTimeout(() => (slide(), k === 4 && done()), 80 * k)))")
                        .await?;
                } else {
                    page.press(Key::Up.to_string().repeat(5)).await?;
                }
                assert_ne!(page.value("#motion-feed_mm_s").await?, before, "slid: {slid}");
                page.js("return new Promise(done => setTimeout(done, 500))").await?;
                current(page).await?;
                page.js("return new Promise(done => setTimeout(done, 3000))").await?;
                let said: Vec<String> = serde_json::from_value(page.js("return window.said").await?)?;
                let settled = [text(page, "verdict").await?, text(page, "status").await?].join(" ");
                assert!(!said.is_empty() && said.len() <= 2, "{address} {slid}: {said:#?}");
                let whole = said.join(" ");
                assert!(whole.contains(&settled), "{whole}, not {settled}");
            }
            Ok(())
        })?;
    }
    Ok(())
}

#[test]
fn each_view_says_how_it_is_computed_with_and_without_javascript() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        for view in ["budget", "path", "forces", "deflection", "error", "joints", "shaper"] {
            page.view(view).await?;
            page.click(&format!("#panel-{view} > .how > summary")).await?;
            let caption = page.text(&format!("#panel-{view} > .how")).await?;
            assert!(caption.contains("Thesis"), "{view}: {caption}");
            let formulas = format!("return document.querySelectorAll('#panel-{view} > .how math').length");
            assert!(page.js(&formulas).await?.as_u64() > Some(0), "{view}");
        }
        page.devtools("Emulation.setScriptExecutionDisabled", json!({ "value": true })).await?;
        // Where the page scrolls smoothly, the driver clicks too early.
        let calm = json!({ "features": [{ "name": "prefers-reduced-motion", "value": "reduce" }] });
        page.devtools("Emulation.setEmulatedMedia", calm).await?;
        page.reload().await?;
        page.click("#panel-forces > .how > summary").await?;
        assert!(page.text("#panel-forces > .how").await?.contains("Thesis eq. 4.11"));
        assert!(page.text("#limits").await?.contains("Dynamics of the arm"));
        assert!(page.text("body").await?.contains("Both are needed"));
        for gone in ["#verdict", "#inputs", ".tabs", "#open-settings", "#fingerprint"] {
            assert_eq!(page.text(gone).await?, "", "{gone} has no use");
        }
        Ok(())
    })
}

#[test]
fn on_paper_it_is_a_report() -> Result {
    visit(THESIS, DESKTOP, async |page| {
        current(page).await?;
        page.wait_for("document.querySelector('#chart-before-after svg.plot')", 20.0).await?;
        page.js("document.querySelector('#open-settings').click(); document.activeElement.blur()").await?;
        assert_eq!(page.js("return document.getElementById('paper').checkVisibility()").await?, false);
        page.devtools("Emulation.setEmulatedMedia", json!({ "media": "print" })).await?;
        // What it is about, when it was printed, and a link that opens the job again.
        page.wait_for(
            "dispatchEvent(new Event('beforeprint')) && document.querySelector('#paper a[href*=\"#job=2.\"]')",
            20.0,
        )
        .await?;
        let head = page.text("#paper").await?;
        let year = page.js("return String(new Date().getFullYear())").await?;
        assert!(head.contains("Armill") && head.contains(year.as_str().unwrap_or("no year")), "{head}");
        let link = page.js("return document.querySelector('#paper a').href").await?;
        let seen = async |css: &str| {
            page.js(&format!(
                "return [...document.querySelectorAll('{css}')].some(element => element.checkVisibility())"
            ))
            .await
        };
        for shown in [
            "#verdict",
            "#before-max",
            "#warnings-list li",
            "#motion-feed_mm_s",
            "#tool-diameter_mm",
            "#chart-before-after svg",
            "#errors",
            "#fingerprint",
        ] {
            assert_eq!(seen(shown).await?, true, "{shown}");
        }
        for hidden in [
            ".tabs",
            ".actions",
            "#undo",
            "#reset",
            "#open-settings",
            "#settings",
            ".program-tools",
            ".explain",
            ".how",
        ] {
            assert_eq!(seen(hidden).await?, false, "{hidden}");
        }
        let paper = page.devtools("Page.printToPDF", json!({ "preferCSSPageSize": true })).await?;
        assert!(paper["data"].as_str().is_some_and(|data| data.len() > 10_000));
        page.js("location.href = 'about:blank'").await?;
        page.js(&format!("location.href = {link}")).await?;
        shows(page, &run(&[])).await?;
        Ok(())
    })
}
