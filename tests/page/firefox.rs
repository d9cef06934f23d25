//! The page in Firefox: the same bits, the first screen, and one program to its package.
//! `cargo xtask test --firefox` runs these; they need Firefox and its driver.

use crate::browser::{DESKTOP, Result, visit_in};
use crate::everywhere;
use crate::personas::{Person, from_a_pocket_to_a_package};
use crate::session::Browser;

#[test]
#[ignore = "needs Firefox: cargo xtask test --firefox"]
fn firefox_computes_the_same_bits() -> Result {
    everywhere::same_bits(Browser::Firefox)
}

#[test]
#[ignore = "needs Firefox: cargo xtask test --firefox"]
fn firefox_has_picture_and_curve_on_the_first_screen() -> Result {
    everywhere::first_screen(Browser::Firefox)
}

#[test]
#[ignore = "needs Firefox: cargo xtask test --firefox"]
fn firefox_takes_a_pocket_to_its_package() -> Result {
    visit_in(Browser::Firefox, "/", DESKTOP, async |page| {
        from_a_pocket_to_a_package(&mut Person::at(page)).await
    })
}
