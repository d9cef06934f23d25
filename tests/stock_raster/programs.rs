//! Random programs in G-code, and stocks.

use armill::stock::{Outline, Solid};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// splitmix64.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub(crate) fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }
}

/// A program being written, in millimetres from the corner of the part.
pub(crate) struct Writer {
    pub(crate) text: String,
    pub(crate) random: Random,
    origin: Vector2<f64>,
    /// Whether it has ramps and helices.
    ramps: bool,
}

impl Writer {
    pub(crate) fn new(seed: u64, origin: Vector2<f64>) -> Self {
        Self { text: "G90 F1000\nG0 X0 Y0 Z5\n".into(), random: Random(seed), origin, ramps: seed % 2 == 1 }
    }

    pub(crate) fn go(&mut self, word: &str, x: f64, y: f64, rest: &str) {
        let at = self.origin + Vector2::new(x, y);
        writeln!(self.text, "{word} X{:.6} Y{:.6} {rest}", at.x, at.y).unwrap();
    }

    pub(crate) fn point(&mut self, from: f64, to: f64) -> [f64; 2] {
        [self.random.within(from, to), self.random.within(from, to)]
    }

    /// Round a centre, from an angle over another, counter-clockwise if positive, down by `down`.
    pub(crate) fn arc(&mut self, [x, y]: [f64; 2], radius: f64, from: f64, sweep: f64, rest: &str) {
        let word = if sweep > 0.0 { "G3" } else { "G2" };
        let (i, j) = (-radius * from.cos(), -radius * from.sin());
        let to = if sweep.abs() >= TAU { from } else { from + sweep };
        self.go(word, x + radius * to.cos(), y + radius * to.sin(), &format!("I{i:.6} J{j:.6} {rest}"));
    }

    /// To a place at the depth: by a plunge, a rapid, from beyond the part, a helix, a ramp.
    pub(crate) fn enter(&mut self, [x, y]: [f64; 2], z: f64) {
        writeln!(self.text, "G0 Z1").unwrap();
        match self.random.below(if self.ramps { 10 } else { 8 }) {
            0..=3 => {
                self.go("G0", x, y, "");
                writeln!(self.text, "G1 Z{z:.4}").unwrap();
            }
            4 | 5 => {
                // Through whatever is there: a rapid clears nothing.
                let [dx, dy] = self.point(-4.0, 4.0);
                self.go("G0", x + dx, y + dy, "");
                writeln!(self.text, "G0 Z{z:.4}").unwrap();
                self.go("G0", x, y, "");
            }
            6 | 7 => {
                self.go("G0", -3.0, y, "");
                writeln!(self.text, "G0 Z{z:.4}").unwrap();
                self.go("G1", x, y, "");
            }
            8 => {
                let radius = self.random.within(0.4, 2.5);
                self.go("G0", x, y, "");
                writeln!(self.text, "G1 Z0").unwrap();
                self.arc([x - radius, y], radius, 0.0, TAU, &format!("Z{:.4}", z / 2.0));
                self.arc([x - radius, y], radius, 0.0, TAU, &format!("Z{z:.4}"));
                self.arc([x - radius, y], radius, 0.0, TAU, "");
            }
            _ => {
                let [dx, dy] = self.point(-4.0, 4.0);
                self.go("G0", x + dx, y + dy, "");
                writeln!(self.text, "G1 Z0").unwrap();
                self.go("G1", x, y, &format!("Z{z:.4}"));
            }
        }
    }

    pub(crate) fn polygon(&mut self, corners: &[[f64; 2]]) {
        for [x, y] in corners {
            self.go("G1", *x, *y, "");
        }
    }

    /// One thing that programs do, at the depth `z`.
    pub(crate) fn feature(&mut self, z: f64) {
        match self.random.below(if self.ramps { 10 } else { 8 }) {
            0 => {
                let ends = [self.point(-2.0, 17.0), self.point(-2.0, 17.0), self.point(0.0, 15.0)];
                self.enter(ends[0], z);
                self.polygon(&ends[1..]);
            }
            kind @ (1 | 2) => {
                let (center, from) = (self.point(1.0, 14.0), self.random.within(0.0, TAU));
                let radius = self.random.within(0.2, if kind == 1 { 2.2 } else { 8.0 });
                let turn = if self.random.below(3) == 0 { TAU } else { self.random.within(0.3, 6.0) };
                let sweep = if self.random.below(2) == 0 { turn } else { -turn };
                self.enter([center[0] + radius * from.cos(), center[1] + radius * from.sin()], z);
                self.arc(center, radius, from, sweep, "");
                // On, further out or further in, from where the arc began.
                let other = (radius + self.random.within(-1.5, 1.5)).max(0.3);
                self.go("G1", center[0] + other * from.cos(), center[1] + other * from.sin(), "");
                self.arc(center, other, from, sweep, "");
            }
            3 => {
                let ([x, y], turn) = (self.point(1.0, 7.0), self.random.within(-0.3, 0.6));
                let (long, over) = (self.random.within(3.0, 8.0), self.random.within(0.3, 4.4));
                let at = |u: f64, v: f64| {
                    [x + u * turn.cos() - v * turn.sin(), y + u * turn.sin() + v * turn.cos()]
                };
                self.enter(at(0.0, 0.0), z);
                for k in 0..(6.0 / over) as usize {
                    let v = k as f64 * over;
                    let ends = if k % 2 == 0 { [at(0.0, v), at(long, v)] } else { [at(long, v), at(0.0, v)] };
                    self.polygon(&ends);
                }
            }
            4 | 5 => {
                // A star of sharp corners around an island or a pocket, a second one further in.
                let ([x, y], count) = (self.point(5.0, 10.0), 3 + self.random.below(4));
                let from = self.random.within(0.0, TAU);
                let radii: Vec<f64> = (0..count).map(|_| self.random.within(2.5, 7.0)).collect();
                let smaller = self.random.within(0.6, 0.97);
                for scale in [1.0, smaller] {
                    let corner = |k: u64| {
                        let (radius, at) = (scale * radii[k as usize], from + k as f64 * TAU / count as f64);
                        [x + radius * at.cos(), y + radius * at.sin()]
                    };
                    let corners: Vec<_> = (0..=count).map(|k| corner(k % count)).collect();
                    self.enter(corners[0], z);
                    self.polygon(&corners[1..]);
                }
            }
            6 => {
                let ([x, y], radius) = (self.point(2.0, 8.0), self.random.within(0.5, 3.0));
                let (step, turn) = (self.random.within(0.2, 1.2), [TAU, -TAU][self.random.below(2) as usize]);
                self.enter([x, y], z);
                for k in 0..6 {
                    let along = x + f64::from(k) * step;
                    self.go("G1", along, y, "");
                    self.arc([along - radius, y], radius, 0.0, turn, "");
                }
            }
            7 => {
                let [x, y] = self.point(0.0, 15.0);
                let [dx, dy] = self.point(-1.5, 1.5);
                for place in [[x, y], [x + dx, y + dy]] {
                    self.go("G0", place[0], place[1], "Z1");
                    writeln!(self.text, "G1 Z{z:.4}\nG0 Z1").unwrap();
                }
            }
            8 => {
                let ([a, b], [c, d]) = (self.point(0.0, 15.0), self.point(0.0, 15.0));
                let half = z / 2.0;
                self.enter([a, b], half);
                self.go("G1", c, d, &format!("Z{z:.4}"));
                self.go("G1", a, b, "");
                self.go("G1", c, d, &format!("Z{half:.4}"));
            }
            _ => {
                let ([x, y], radius) = (self.point(3.0, 12.0), self.random.within(0.5, 4.0));
                self.go("G0", x + radius, y, "Z1");
                writeln!(self.text, "G1 Z0").unwrap();
                for k in 1..=2 {
                    self.arc([x, y], radius, 0.0, -TAU, &format!("Z{:.4}", z * f64::from(k) / 2.0));
                }
                self.arc([x, y], radius, 0.0, -TAU, "");
                self.arc([x, y], radius, 0.0, 4.0, "");
            }
        }
        writeln!(self.text, "G0 Z5").unwrap();
    }
}

/// A box, a cylinder or an L of 15 x 15 x 5 mm, its top at 0.
pub(crate) fn stock(kind: u64, origin: Vector2<f64>) -> Solid {
    let at = |x: f64, y: f64| (origin + Vector2::new(x, y)) / 1e3;
    let outline = match kind {
        0 => Outline::rectangle(at(0.0, 0.0), at(15.0, 15.0)),
        1 => Outline::Circle { center: at(7.5, 7.5), radius: 7.5e-3 },
        _ => Outline::Polygon(vec![
            at(0.0, 0.0),
            at(15.0, 1.0),
            at(14.0, 6.0),
            at(6.0, 7.0),
            at(8.0, 15.0),
            at(1.0, 14.0),
        ]),
    };
    Solid::prism(outline, -5e-3, 0.0)
}
