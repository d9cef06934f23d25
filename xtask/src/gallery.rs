//! The pictures of the gallery, taken of the page with each of its jobs.

use std::fs;
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use serde_json::json;

use crate::picture::Visit;
use crate::site::gallery::link;
use crate::workspace;

/// Width and height of a picture [CSS pixels].
const SIZE: (u32, u32) = (640, 400);

/// Bytes of the largest picture, and of all together.
const LIMITS: [usize; 2] = [40_000, 400_000];

/// What a picture shows.
enum Shot {
    /// The picture in space, after the button of a view, at a sample of the run.
    Scene { view: &'static str, sample: usize },
    /// The error curve.
    Curve,
}

/// Name of the card, and of its job in `web/gallery` unless the core has it; what its picture shows.
const SHOTS: [(&str, Shot); 8] = [
    ("bracket", Shot::Scene { view: "fit", sample: 0 }),
    ("reach", Shot::Scene { view: "all", sample: 0 }),
    ("climb", Shot::Scene { view: "fit", sample: 0 }),
    ("aluminium", Shot::Scene { view: "fit", sample: 0 }),
    ("spindle", Shot::Scene { view: "all", sample: 0 }),
    // Where joint 5 is out of its range.
    ("dome", Shot::Scene { view: "all", sample: 400 }),
    ("guess", Shot::Curve),
    ("thesis", Shot::Curve),
];

impl Shot {
    /// The size of a view in which what is taken is about as large as the picture.
    fn view(&self) -> (u32, u32) {
        match self {
            Shot::Scene { .. } => (1707, 826),
            Shot::Curve => (1671, 728),
        }
    }

    /// JavaScript that prepares the page, and returns the place to take: x, y, width and height.
    fn prepare(&self) -> String {
        let (before, place, buttons) = match self {
            Shot::Scene { view, sample } => (
                format!(
                    "document.querySelector('#scene [data-view={view}]').click(); \
                     const time = document.querySelector('#scene .player input'); \
                     time.value = {sample}; time.dispatchEvent(new Event('input', {{ bubbles: true }}));"
                ),
                "#scene .stage",
                "#scene .stated, #scene .part-corner .sides",
            ),
            Shot::Curve => (String::new(), "#curve figure", "#curve .chart-tools"),
        };
        format!(
            "{before} for (const button of document.querySelectorAll('{buttons}')) button.style.visibility = 'hidden'; \
             const {{ x, y, width, height }} = document.querySelector('{place}').getBoundingClientRect(); \
             return [x, y, width, height]"
        )
    }
}

/// Takes all pictures and writes them to `web/gallery`.
///
/// # Errors
/// If the site does not build, there is no browser, a job shows no result in time, or a picture is too
/// large.
pub(crate) fn take() -> Result<()> {
    let folder = workspace::root()?.join("web/gallery");
    let visit = Visit::start()?;
    let mut all = 0;
    for (name, shot) in &SHOTS {
        let file = folder.join(format!("{name}.json"));
        let fragment =
            if file.exists() { link(&fs::read_to_string(&file)?)? } else { format!("example={name}") };
        visit.open(&fragment, shot.view())?;
        let place = visit.js(&shot.prepare())?;
        let at = |k: usize| place[k].as_f64().with_context(|| format!("{name}: nothing to take"));
        let (width, height) = (f64::from(SIZE.0), f64::from(SIZE.1));
        ensure!(
            (at(2)? - width).abs() < 2.0 && (at(3)? - height).abs() < 2.0,
            "{name}: {place} is not {SIZE:?}"
        );
        // The picture in space turns to its view.
        thread::sleep(Duration::from_secs(2));
        let clip = json!({ "x": at(0)?, "y": at(1)?, "width": width, "height": height, "scale": 1 });
        let bytes = visit.picture(json!({ "format": "webp", "quality": 85, "clip": clip }))?;
        ensure!(
            bytes.len() <= LIMITS[0],
            "{name} has {} bytes, at most {} are allowed",
            bytes.len(),
            LIMITS[0]
        );
        all += bytes.len();
        fs::write(folder.join(format!("{name}.webp")), &bytes)?;
    }
    ensure!(all <= LIMITS[1], "the pictures have {all} bytes, at most {} are allowed", LIMITS[1]);
    println!("The pictures are in web/gallery ({} kB)", all / 1000);
    Ok(())
}
