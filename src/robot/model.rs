//! The arm: modified Denavit-Hartenberg table, joint limits, joint compliance, tool (thesis Tables
//! 3.1, 3.2, 3.4).
//!
//! Armill solves arms of the RX-90's family in closed form: an ortho-parallel base (axes 1 and 2 at
//! right angles, crossing or offset; axes 2 and 3 parallel) and a spherical wrist (axes 4, 5, 6
//! meet in one point). Other six-joint arms are solved by iteration; [`Robot::closed_form`] names
//! the row of the table that does not fit.

use crate::error::Error;
use crate::math::{self, Pose};
use crate::robot::JointStatics;
use crate::robot::equilibrium::equilibrium;
use crate::units::{DEG, MM};
use nalgebra::{Vector3, Vector6};

/// Six joint values [rad].
pub type Joints = Vector6<f64>;

/// One row of a modified Denavit-Hartenberg table: from frame i-1 to frame i (eq. 3.1, Table 3.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// Twist alpha_{i-1} about x_{i-1} [rad].
    pub alpha: f64,
    /// Length a_{i-1} along x_{i-1} [m].
    pub a: f64,
    /// Offset d_i along z_i [m].
    pub d: f64,
    /// Constant part of the angle about z_i [rad]: theta_i = sign * q_i + theta_offset.
    pub theta_offset: f64,
    /// +1, or -1 where the manufacturer counts the joint in the other direction.
    pub sign: f64,
}

impl Link {
    /// The angle about z_i [rad] for the joint value `q` [rad].
    pub(crate) fn theta(&self, q: f64) -> f64 {
        self.sign * q + self.theta_offset
    }

    /// The joint value [rad] for the angle `theta` about z_i [rad].
    pub(crate) fn joint(&self, theta: f64) -> f64 {
        self.sign * (theta - self.theta_offset)
    }

    /// Cosine and sine of the twist, exact for multiples of 90 degrees.
    pub(crate) fn twist(&self) -> (f64, f64) {
        match quarter_turns(self.alpha) {
            Some(0) => (1.0, 0.0),
            Some(1) => (0.0, 1.0),
            Some(2) => (-1.0, 0.0),
            Some(_) => (0.0, -1.0),
            None => (math::cos(self.alpha), math::sin(self.alpha)),
        }
    }
}

/// The number of quarter turns (0 to 3) in an angle, or `None` if it is not a multiple of 90
/// degrees within 1e-9 rad.
fn quarter_turns(angle: f64) -> Option<u8> {
    let turns = angle / math::FRAC_PI_2;
    let whole = turns.round();
    ((turns - whole).abs() < 1e-9).then(|| whole.rem_euclid(4.0) as u8)
}

/// Parameters of the closed-form inverse: signs of the twists and lengths of the planar arm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Geometry {
    /// Sines of the twists alpha_1, alpha_3, alpha_4, alpha_5: +1 or -1.
    pub(crate) sin_1: f64,
    pub(crate) sin_4: f64,
    pub(crate) sin_5: f64,
    /// Cosine of alpha_2: +1 or -1.
    pub(crate) cos_2: f64,
    /// Upper arm a_2 [m].
    pub(crate) upper: f64,
    /// Distance from axis 3 to the wrist centre [m].
    pub(crate) fore: f64,
    /// x and y of the wrist centre in frame 3 [m].
    pub(crate) fore_direction: (f64, f64),
    /// Offset of the arm's plane from axis 1, along axis 2 [m].
    pub(crate) lateral: f64,
}

/// Where joint 3 is measured from, and where its drive sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Elbow {
    /// Measured from the upper arm; the drive is at the elbow.
    #[default]
    Serial,
    /// Measured from the base: the controller reports the forearm's inclination (FANUC's pendants),
    /// but the drive is at the elbow.
    Pendant,
    /// Measured from the base, where the drive sits and holds the forearm's inclination through a
    /// parallelogram.
    Parallelogram,
}

/// A six-joint arm with its joint compliance and its tool. The base frame is {B} (the thesis's
/// {M}).
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    name: String,
    links: [Link; 6],
    limits: Option<[(f64, f64); 6]>,
    compliance: Joints,
    tool: Pose,
    flange: Pose,
    elbow: Elbow,
    statics: Option<Box<JointStatics>>,
    sag: [(Vector3<f64>, Vector3<f64>); 6],
    pub(crate) twists: [(f64, f64); 6],
    geometry: Result<Geometry, Error>,
}

impl Robot {
    /// An arm from its modified DH table.
    ///
    /// `limits` are the joints' ranges [rad], `compliance` the joints' compliances C_theta [rad/(N
    /// m)] (eq. 3.43).
    ///
    /// # Errors
    /// [`Error::Invalid`] with the row and the value if an entry of the table, a limit or a
    /// compliance is invalid. Field names are those of the job (`robot.modified_dh[1].alpha_deg`).
    pub fn new(
        name: impl Into<String>,
        links: [Link; 6],
        limits: Option<[(f64, f64); 6]>,
        compliance: [f64; 6],
    ) -> Result<Self, Error> {
        for (i, &c) in compliance.iter().enumerate() {
            if !(c.is_finite() && c >= 0.0) {
                let field = format!("robot.joint_compliance_rad_per_nm[{i}]");
                return Err(Error::invalid(field, c, "a compliance is zero (rigid) or positive"));
            }
        }
        for (i, &(low, high)) in limits.iter().flatten().enumerate() {
            if !(low.is_finite() && high.is_finite() && low < high) {
                let value = format!("[{}, {}]", low / DEG, high / DEG);
                let expected = "a range is [lowest, highest] with the lowest first";
                return Err(Error::invalid(format!("robot.joint_limits_deg[{i}]"), value, expected));
            }
        }
        for (i, link) in links.iter().enumerate() {
            for (key, value, unit) in [
                ("alpha_deg", link.alpha, DEG),
                ("a_mm", link.a, MM),
                ("d_mm", link.d, MM),
                ("theta_offset_deg", link.theta_offset, DEG),
            ] {
                if !value.is_finite() {
                    return Err(Error::invalid(cell(i, key), value / unit, "a finite number is needed"));
                }
            }
            if link.sign.abs() != 1.0 {
                let expected = "the sign of a joint is 1 or -1";
                return Err(Error::invalid(cell(i, "joint_sign"), link.sign, expected));
            }
        }
        Ok(Self {
            name: name.into(),
            links,
            limits,
            compliance: Joints::from(compliance),
            tool: Pose::identity(),
            flange: Pose::identity(),
            elbow: Elbow::Serial,
            statics: None,
            sag: [(Vector3::zeros(), Vector3::zeros()); 6],
            twists: links.map(|link| link.twist()),
            geometry: Geometry::of(&links),
        })
    }

    /// This arm with a tool: the TCP in the flange frame.
    pub fn with_tool(mut self, tool: Pose) -> Self {
        self.tool = tool;
        self.flange = tool.inverse();
        self
    }

    /// This arm with compliances that are these factors times its own.
    pub fn softened(mut self, factors: &[f64; 6]) -> Self {
        self.compliance.component_mul_assign(&Joints::from(*factors));
        self
    }

    /// This arm with joint 3 measured from elsewhere.
    ///
    /// # Errors
    /// [`Error::Invalid`] if axes 2 and 3 are not parallel: the forearm's inclination is then
    /// undefined.
    pub fn with_elbow(mut self, elbow: Elbow) -> Result<Self, Error> {
        if elbow != Elbow::Serial && quarter_turns(self.links[2].alpha).is_none_or(|turns| turns % 2 != 0) {
            let expected = "axes 2 and 3 that are parallel: alpha of row 3 is 0 or 180";
            return Err(Error::invalid("robot.joint_3", "counted from the base", expected));
        }
        self.elbow = elbow;
        Ok(self)
    }

    /// Where joint 3 is measured from, and where its drive sits.
    pub fn elbow(&self) -> Elbow {
        self.elbow
    }

    /// How far axis 3 turns relative to the upper arm, in joint 3's own direction, for each turn of
    /// joint 2 while joint 3 is commanded constant. Holding the forearm's inclination s_2 q_2
    /// cos(alpha_2) + s_3 q_3 constant gives -s_2 s_3 cos(alpha_2).
    pub(crate) fn elbow_coupling(&self) -> f64 {
        let (cos_2, _) = self.twists[2];
        if self.elbow == Elbow::Serial { 0.0 } else { -self.links[1].sign * self.links[2].sign * cos_2 }
    }

    /// Converts the controller's joint values to values with joint 3 measured from the upper arm.
    pub(crate) fn to_serial(&self, q: &Joints) -> Joints {
        let mut q = *q;
        if self.elbow != Elbow::Serial {
            q[2] += self.elbow_coupling() * q[1];
        }
        q
    }

    /// Converts values with joint 3 measured from the upper arm to the controller's joint values.
    pub(crate) fn to_controller(&self, q: &Joints) -> Joints {
        let mut q = *q;
        if self.elbow != Elbow::Serial {
            q[2] -= self.elbow_coupling() * q[1];
        }
        q
    }

    /// This arm with nonlinear springs, or with the weight it carries.
    pub fn with_statics(mut self, statics: JointStatics) -> Self {
        self.statics = Some(Box::new(statics));
        self
    }

    /// This arm with its sag at the joint commands `q` [rad] taken as zero, if the workpiece was
    /// touched off there.
    pub fn touched_off_at(mut self, q: &Joints) -> Self {
        if let Some(statics) = self.statics().filter(|statics| statics.touched_off) {
            self.sag = equilibrium(&self, statics, q, &Vector3::zeros()).parts;
        }
        self
    }

    /// Springs and weight, if the arm has more than [`Robot::compliance`].
    pub fn statics(&self) -> Option<&JointStatics> {
        self.statics.as_deref()
    }

    /// Displacement [m] and rotation [rad] of the TCP by each joint's sag where the workpiece was
    /// touched off.
    pub(crate) fn sag(&self) -> &[(Vector3<f64>, Vector3<f64>); 6] {
        &self.sag
    }

    /// The arm's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The modified DH table.
    pub fn links(&self) -> &[Link; 6] {
        &self.links
    }

    /// The joints' ranges [rad], if known.
    pub fn limits(&self) -> Option<&[(f64, f64); 6]> {
        self.limits.as_ref()
    }

    /// Least distance of a joint from the ends of its range [rad]: negative beyond them, infinite if the ranges are
    /// unknown.
    pub fn limit_room(&self, q: &Joints) -> f64 {
        let ranges = self.limits.iter().flatten().zip(q.iter());
        ranges.map(|((low, high), q)| (q - low).min(high - q)).fold(f64::INFINITY, f64::min)
    }

    /// The diagonal of C_theta [rad/(N m)] (eq. 3.43).
    pub fn compliance(&self) -> &Joints {
        &self.compliance
    }

    /// The TCP in the flange frame.
    pub fn tool(&self) -> &Pose {
        &self.tool
    }

    /// The flange in the TCP's frame.
    pub(crate) fn flange(&self) -> &Pose {
        &self.flange
    }

    /// Smallest and largest distance of the wrist centre from axis 2 [m]. For an arm that is solved
    /// numerically this is a bound: the distance from frame 1's origin with all links in line.
    pub fn reach(&self) -> (f64, f64) {
        match self.geometry {
            Ok(Geometry { upper, fore, .. }) => ((upper.abs() - fore).abs(), upper.abs() + fore),
            Err(_) => {
                let last = self.links[5].a.abs();
                (0.0, last + self.links[1..5].iter().map(|link| math::hypot(link.a, link.d)).sum::<f64>())
            }
        }
    }

    /// Parameters of the closed form; the error says why this arm has none.
    pub(crate) fn geometry(&self) -> Result<&Geometry, &Error> {
        self.geometry.as_ref()
    }

    /// Whether the inverse has a closed form; the error names the row of the table that prevents
    /// it.
    ///
    /// # Errors
    /// [`Error::Invalid`] with the row, its value and what the closed form needs there.
    pub fn closed_form(&self) -> Result<(), &Error> {
        self.geometry.as_ref().map(|_| ())
    }
}

impl Geometry {
    /// Derives the family's parameters from the table, or names the row that does not fit.
    fn of(links: &[Link; 6]) -> Result<Self, Error> {
        let turn = |i: usize, allowed: [u8; 2], expected: &'static str| match quarter_turns(links[i].alpha) {
            Some(turns) if allowed.contains(&turns) => Ok(if turns == allowed[0] { 1.0 } else { -1.0 }),
            _ => Err(Error::invalid(cell(i, "alpha_deg"), links[i].alpha / DEG, expected)),
        };
        turn(0, [0, 2], "the closed form needs axis 1 vertical in the base frame: 0 or 180")?;
        let sin_1 = turn(1, [1, 3], "the closed form needs axes 1 and 2 at right angles: 90 or -90")?;
        let cos_2 = turn(2, [0, 2], "the closed form needs axes 2 and 3 parallel: 0 or 180")?;
        let sin_3 = turn(3, [1, 3], "the closed form needs axes 3 and 4 at right angles: 90 or -90")?;
        let sin_4 = turn(4, [1, 3], "the closed form needs axes 4 and 5 at right angles: 90 or -90")?;
        let sin_5 = turn(5, [1, 3], "the closed form needs axes 5 and 6 at right angles: 90 or -90")?;
        for (i, key, value) in [(4, "a_mm", links[4].a), (4, "d_mm", links[4].d), (5, "a_mm", links[5].a)] {
            if value.abs() > 1e-9 {
                let expected =
                    "the closed form needs axes 4, 5 and 6 to meet in one point (spherical wrist): 0";
                return Err(Error::invalid(cell(i, key), value / MM, expected));
            }
        }
        // The wrist centre in frame 3 is (a_3, -d_4 sin(alpha_3), 0).
        let (along, across) = (links[3].a, -sin_3 * links[3].d);
        let fore = math::hypot(along, across);
        if links[2].a.abs() < 1e-6 {
            return Err(Error::invalid(cell(2, "a_mm"), links[2].a / MM, "the upper arm needs a length"));
        }
        if fore < 1e-6 {
            return Err(Error::invalid(cell(3, "d_mm"), links[3].d / MM, "the forearm needs a length"));
        }
        Ok(Self {
            sin_1,
            sin_4,
            sin_5,
            cos_2,
            upper: links[2].a,
            fore,
            fore_direction: (along, across),
            lateral: links[1].d + cos_2 * links[2].d,
        })
    }
}

/// JSON path of an entry of the modified DH table.
fn cell(row: usize, key: &str) -> String {
    format!("robot.modified_dh[{row}].{key}")
}
