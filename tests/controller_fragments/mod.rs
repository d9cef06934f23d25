//! The readers of robot programs (`controllers/`) held to public fragments, with matrices derived another way,
//! and to faulty programs, each refused for its own reason.
#![allow(clippy::disallowed_methods, reason = "compared within a tolerance, not bit by bit")]

mod fanuc;
mod krl;
mod rapid;
mod val3;

use crate::controllers::{ControllerProgram, File};
use nalgebra::{Matrix3, Vector3};

type Reader = fn(&[File]) -> Result<ControllerProgram, String>;

fn package(files: &[(&str, &str)]) -> Vec<File> {
    files.iter().map(|(path, text)| File { path: (*path).to_owned(), text: (*text).to_owned() }).collect()
}

/// Asserts that a package is read, with either kind of line ends, and refused for each of these faults: a text that
/// stands in it, what stands there instead, and the reason that is given.
fn refuses(read: Reader, files: &[(&str, &str)], faults: &[(&str, &str, &str)]) {
    let unix = read(&package(files)).unwrap();
    let mut windows = package(files);
    windows.iter_mut().for_each(|file| file.text = file.text.replace('\n', "\r\n"));
    assert_eq!(format!("{:?}", read(&windows).unwrap()), format!("{unix:?}"));
    windows[0].text.push('\n');
    assert!(read(&windows).unwrap_err().contains("line ends of two kinds"));
    for (text, fault, message) in faults {
        let changed: Vec<File> = files
            .iter()
            .map(|(path, whole)| File { path: (*path).to_owned(), text: whole.replacen(text, fault, 1) })
            .collect();
        assert!(files.iter().any(|(_, whole)| whole.contains(text)), "{text} stands in the package");
        let error = read(&changed).expect_err(fault);
        assert!(error.contains(message), "`{fault}` gave: {error}");
    }
}

/// Numbers are written to six digits or less.
fn near(found: &Matrix3<f64>, rows: [[f64; 3]; 3]) {
    let expected = Matrix3::from_fn(|row, column| rows[row][column]);
    assert!((found - expected).amax() < 2e-6, "{found} is not {expected}");
}

fn at(found: Vector3<f64>, expected: Vector3<f64>) {
    assert!((found - expected).amax() < 1e-9, "{found} is not {expected}");
}

/// The same three numbers turn differently: KUKA's and FANUC's about Z, Y, X in this order, Staubli's about X, Y, Z,
/// which is the inverse of KUKA's with all signs changed.
#[test]
fn each_controller_has_its_own_angles() {
    let kuka = krl::turned([10.0, 20.0, 30.0]);
    let fanuc = fanuc::turned([30.0, 20.0, 10.0]);
    let staubli = val3::turned([30.0, 20.0, 10.0]);
    assert!((kuka - fanuc).amax() < 1e-15, "A is R, C is W");
    assert!((kuka - staubli).amax() > 0.1);
    assert!((kuka - val3::turned([-30.0, -20.0, -10.0]).transpose()).amax() < 1e-15);
}
