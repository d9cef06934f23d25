//! Loaded poses as text.

use armill::Error;
use armill::identify::Convention;
use armill::identify::measurement::{Measurements, read};

fn table(text: &str) -> Measurements {
    read(text, Convention::Table).unwrap()
}

#[track_caller]
fn refused(text: &str, place: (usize, usize), part: &str) {
    let error: Error = read(text, Convention::Table).expect_err(text);
    assert_eq!((error.place(), error.field()), (Some(place), Some("measurements")), "{error}");
    assert!(error.to_string().contains(part), "{error}");
}

const ROW: &str = "10, 20, 30, 40, 50, 60, 100, -200, 300, 0.5, -0.25, 0.125";

#[test]
fn every_way_of_writing_gives_the_same_rows() {
    let expected = table(ROW).rows;
    assert_eq!(expected[0].displacement, [Some(0.5e-3), Some(-0.25e-3), Some(0.125e-3)]);
    assert!((expected[0].q[5].to_degrees() - 60.0).abs() < 1e-12 && expected[0].wrench[1] == -200.0);
    for text in [
        "10;20;30;40;50;60;100;-200;300;0,5;-0,25;0,125",
        "10 20\t30 40 50 60 100 -200 300 0,5 -0,25 0,125",
        "# a comment\n\n10 20 30 40 50 60 100 -200 300 0.5 -0.25 0.125 # more",
    ] {
        assert_eq!(table(text).rows[0].displacement, expected[0].displacement, "{text}");
        assert_eq!(table(text).rows[0].q, expected[0].q, "{text}");
    }
    let named = "dz_um;Force X [kN];fy_n;fz_n;q6_deg;q5_deg;q4;joint 3;j2;q1_deg;dy [mm];dx_m_base\n\
                 125;0.1;-200;300;60;50;40;30;20;10;-0.25;0.0005";
    let row = &table(named).rows[0];
    assert_eq!((row.q, row.wrench, row.line), (expected[0].q, expected[0].wrench, 2));
    for (ours, theirs) in row.displacement.iter().zip(expected[0].displacement) {
        assert!((ours.unwrap() - theirs.unwrap()).abs() < 1e-18);
    }
}

#[test]
fn moments_and_what_was_not_measured() {
    let row = &table("1,2,3,4,5,6,7,8,9,10,11,12,0.1,0.2,0.3").rows[0];
    assert_eq!(row.wrench.as_slice(), [7.0, 8.0, 9.0, 10.0, 11.0, 12.0]);
    let header = "q1,q2,q3,q4,q5,q6,fx,fy,fz,dx,dz\n";
    let rows = table(&format!("{header}1,2,3,4,5,6,7,8,9,0.1,\n1,2,3,4,5,6,7,8,9,,0.3\n")).rows;
    assert_eq!(rows[0].displacement, [Some(1e-4), None, None]);
    assert_eq!(rows[1].displacement[2], Some(0.3 * 1e-3));
}

#[test]
fn angles_that_look_like_radians_are_remarked_on() {
    let small = "0.1, 0.2, 3, -1, 0.5, 6.2, 100, -200, 300, 0.5, -0.25, 0.125";
    assert!(table(small).remarks[0].contains("q1_rad"));
    assert!(table(ROW).remarks.is_empty());
    let said = format!("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,fx,fy,fz,dx,dy,dz\n{small}");
    assert!(table(&said).remarks.is_empty());
}

#[test]
fn errors_name_line_and_column() {
    refused("", (1, 1), "without numbers");
    refused("1, 2, 3", (1, 1), "q1 to q6");
    refused(&format!("{ROW}\n{ROW}, 7"), (2, 60), "12 cells");
    refused(&format!("{ROW}\n10, 20, thirty, 40, 50, 60, 1, 2, 3, 0, 0, 0"), (2, 9), "a number");
    refused(&format!("{ROW}\n10, 20, , 40, 50, 60, 1, 2, 3, 0, 0, 0"), (2, 9), "every row needs");
    refused("10, 20, 30, 40, 50, 60, 100, -200, 300, 5000, 0, 0", (1, 41), "at most 1 m");
    let header = |names: &str| format!("{names}\n1,2,3,4,5,6,7,8,9,0.1,0.2,0.3");
    refused(&header("q1,q2,q3,q4,q5,q7,fx,fy,fz,dx,dy,dz"), (1, 16), "the columns are");
    refused(&header("q1,q2,q3,q4,q5,q1,fx,fy,fz,dx,dy,dz"), (1, 16), "once");
    refused(&header("q1,q2,q3,q4,q5,q6,fx_tool,fy,fz,dx,dy,dz"), (1, 19), "base frame");
    refused(&header("q1,q2,q3,q4,q5,q6,fx,fy,fz,mx,dy,dz"), (1, 34), "or none");
    refused(&header("q1,q2,q3,q4,q5,q6,fx,fy,mz,dx,dy,dz"), (1, 34), "fx, fy and fz");
    assert!(Convention::of("fanuc").unwrap_err().to_string().contains("coupled-j3"));
}
