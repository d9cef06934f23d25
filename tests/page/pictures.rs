//! Twelve pictures of the page, compared with those in `tests/page/pictures/`: what no box of the
//! layout tells, such as a part that is not drawn, colours gone or text on text.
//! `cargo xtask test --heavy` compares them; with `ARMILL_PICTURES=take` it takes them again: look at
//! them before they are committed.

use std::fs;
use std::path::PathBuf;

use crate::browser::{DESKTOP, PHONE, Page, Result, Size, THESIS, visit};
use crate::current;

/// A picture: its name, the page's address and size, whether it is dark, and what is done first.
type Scene = (&'static str, &'static str, Size, bool, &'static str);

const SCENES: [Scene; 12] = [
    ("opening", "/", DESKTOP, false, ""),
    ("opening-dark", "/", DESKTOP, true, ""),
    ("opening-1024", "/", (1024, 768), false, ""),
    ("opening-tablet", "/", (820, 1180), false, ""),
    ("opening-phone", "/", PHONE, false, ""),
    ("opening-phone-dark", "/", PHONE, true, ""),
    ("opening-phone-on-its-side", "/", (844, 390), false, ""),
    ("thesis", THESIS, DESKTOP, false, ""),
    ("budget", "/#view=budget", DESKTOP, false, SHOW_VIEWS),
    ("forces-dark", "/#view=forces", DESKTOP, true, SHOW_VIEWS),
    ("phone-inputs", "/", PHONE, false, "document.querySelector('#inputs-toggle').click()"),
    ("embed", "/embed.html#show=scene+budget&inputs=motion", DESKTOP, false, ""),
];

const SHOW_VIEWS: &str = "document.querySelector('#views').scrollIntoView({ behavior: 'instant' })";

/// Edge of a block whose mean colour is compared [px]: edges of letters differ by machine, what they
/// fill does not.
const BLOCK: usize = 8;
/// Difference of a channel's mean from which a block counts as another, of 255.
const CHANNEL: f64 = 10.0;
/// Largest share of the blocks that may.
const SHARE: f64 = 0.005;

/// A picture as rows of pixels, red, green and blue.
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    fn read(bytes: &[u8]) -> Result<Picture> {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info()?;
        let mut data = vec![0; reader.output_buffer_size().ok_or("too large")?];
        let frame = reader.next_frame(&mut data)?;
        let channels = frame.color_type.samples();
        let pixels = data[..frame.buffer_size()].chunks(channels).map(|each| [each[0], each[1], each[2]]);
        Ok(Picture { width: frame.width as usize, height: frame.height as usize, pixels: pixels.collect() })
    }

    /// Mean colour of the block at this column and row.
    fn mean(&self, column: usize, row: usize) -> [f64; 3] {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for y in (row * BLOCK..(row + 1) * BLOCK).take_while(|y| *y < self.height) {
            for x in (column * BLOCK..(column + 1) * BLOCK).take_while(|x| *x < self.width) {
                let pixel = self.pixels[y * self.width + x];
                (0..3).for_each(|i| sum[i] += f64::from(pixel[i]));
                count += 1.0;
            }
        }
        sum.map(|sum| sum / count)
    }

    /// The share of blocks that differ from those of another picture of the same size.
    fn differs(&self, other: &Picture) -> f64 {
        assert_eq!((self.width, self.height), (other.width, other.height), "sizes");
        let (columns, rows) = (self.width.div_ceil(BLOCK), self.height.div_ceil(BLOCK));
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let another = places.filter(|&(column, row)| {
            let (a, b) = (self.mean(column, row), other.mean(column, row));
            (0..3).any(|i| (a[i] - b[i]).abs() > CHANNEL)
        });
        another.count() as f64 / (columns * rows) as f64
    }
}

/// Takes a picture at half size, so that twelve take little room.
async fn taken(page: &Page, (name, _, size, dark, first): &Scene) -> Result<Vec<u8>> {
    current(page).await?;
    page.prefer_dark(*dark).await?;
    page.resize_at(*size, 0.5).await?;
    if !first.is_empty() {
        page.js(first).await?;
    }
    page.wait_for("document.querySelector('svg .series')", 30.0).await?;
    page.wait_for(
        "[...document.querySelectorAll('#scene')].every(each => each.dataset.sample !== undefined)",
        30.0,
    )
    .await?;
    // Whatever fades, is measured or follows the result, such as the accuracy as a program.
    page.js("return new Promise(done => setTimeout(done, 2500))").await?;
    page.js("return Promise.all(document.getAnimations().map(each => each.finished.catch(() => {})))")
        .await?;
    Ok(fs::read(page.screenshot(&format!("{name}.png")).await?)?)
}

fn committed(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/page/pictures/{name}.png"))
}

/// Compares some of the pictures.
fn compare(scenes: &[Scene]) -> Result {
    let mut notes = Vec::new();
    for scene in scenes {
        let (name, address, size, ..) = *scene;
        visit(address, size, async |page| {
            let now = taken(page, scene).await?;
            if std::env::var("ARMILL_PICTURES").as_deref() == Ok("take") {
                return Ok(fs::write(committed(name), now)?);
            }
            let known = Picture::read(&fs::read(committed(name))?)?;
            let share = known.differs(&Picture::read(&now)?);
            if share > SHARE {
                notes.push(format!("{name}: {:.1} % of the picture is another", 100.0 * share));
            }
            Ok(())
        })?;
    }
    if notes.is_empty() { Ok(()) } else { Err(notes.join("\n").into()) }
}

// Two tests, because tests run side by side.
#[test]
#[ignore = "takes a minute: cargo xtask test --heavy"]
fn the_first_screens_look_as_they_did() -> Result {
    compare(&SCENES[..6])
}

#[test]
#[ignore = "takes a minute: cargo xtask test --heavy"]
fn other_views_look_as_they_did() -> Result {
    compare(&SCENES[6..])
}

/// The comparison would notice a theme of the wrong kind, an empty picture in space, and a stretch of
/// text that went.
#[test]
fn the_comparison_notices() -> Result {
    let read = |name: &str| Picture::read(&fs::read(committed(name))?);
    let (light, dark) = (read("opening")?, read("opening-dark")?);
    assert_eq!(light.differs(&light), 0.0);
    assert!(light.differs(&dark) > 0.5);
    // The scene's half of the first screen, and one line of text.
    for (left, right, top, bottom) in [(180, 390, 90, 190), (170, 600, 30, 46)] {
        let mut emptied = read("opening")?;
        for y in top..bottom {
            for x in left..right {
                emptied.pixels[y * emptied.width + x] = [250, 250, 250];
            }
        }
        let share = light.differs(&emptied);
        assert!(share > SHARE, "{share}");
    }
    Ok(())
}
