//! The meaning of each G and M number: its modal group, no effect, or the reason why it is refused.

/// A modal group: a block may hold one of its codes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Group {
    /// G0 to G3.
    Motion,
    /// G73, G80 to G83, G85, G89. A group of its own, as on most controllers: `G0 G80` is a common
    /// first line.
    Cycle,
    /// G17, G18, G19.
    Plane,
    /// G20, G21 (G70, G71).
    Unit,
    /// G90, G91.
    Distance,
    /// G90.1, G91.1.
    ArcDistance,
    /// G93, G94, G95.
    FeedMode,
    /// G43, G44, G49.
    ToolLength,
    /// G98, G99.
    Retract,
    /// G54 to G59.3.
    WorkOffset,
    /// G61, G61.1, G64.
    Blending,
    /// G4, G10, G28, G30, G52, G53, G92, G92.1: active in their own block only.
    NonModal,
    /// M3, M5.
    Spindle,
    /// M0, M1, M2, M17, M30, M60, M99.
    Stop,
    /// M6.
    ToolChange,
}

/// G54.1 P (Fanuc) and G154 P (Haas): offsets beyond G59.
pub(super) const EXTENDED_OFFSET: u32 = 541;
/// See [`EXTENDED_OFFSET`].
pub(super) const HAAS_OFFSET: u32 = 1540;

/// G110 to G129 (Haas): the first twenty of them.
pub(super) const HAAS_FIRST: u32 = 1100;
/// See [`HAAS_FIRST`].
pub(super) const HAAS_LAST: u32 = 1290;

/// Number of groups.
pub(super) const GROUPS: usize = Group::ToolChange as usize + 1;

/// The meaning of a code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meaning {
    /// Active, and the only one of its group.
    Acts(Group),
    /// Has no effect on the path, and takes these letters along.
    Harmless(&'static [char]),
    /// Would change the path (or the forces) in a way that is not modelled; what to do instead.
    Refused(&'static str),
}

/// The meaning of the G code with this number in tenths (`G43.1` is 431).
pub(super) fn g(tenths: u32) -> Meaning {
    use Meaning::{Acts, Harmless, Refused};
    match tenths {
        0 | 10 | 20 | 30 => Acts(Group::Motion),
        730 | 800 | 810 | 820 | 830 | 850 | 890 => Acts(Group::Cycle),
        170 | 180 | 190 => Acts(Group::Plane),
        200 | 210 | 700 | 710 => Acts(Group::Unit),
        900 | 910 => Acts(Group::Distance),
        901 | 911 => Acts(Group::ArcDistance),
        930 | 940 | 950 => Acts(Group::FeedMode),
        430 | 440 | 490 => Acts(Group::ToolLength),
        980 | 990 => Acts(Group::Retract),
        // Siemens names the units so for feeds as well.
        7000 | 7100 => Acts(Group::Unit),
        540 | 550 | 560 | 570 | 580 | 590 | 591 | 592 | 593 | EXTENDED_OFFSET | HAAS_OFFSET => {
            Acts(Group::WorkOffset)
        }
        HAAS_FIRST..=HAAS_LAST if tenths.is_multiple_of(10) => Acts(Group::WorkOffset),
        610 | 611 | 640 => Acts(Group::Blending),
        40 | 100 | 280 | 300 | 520 | 530 | 920 | 921 => Acts(Group::NonModal),
        // Each ends a mode whose start is refused, or names the only mode there is.
        131 | 150 | 230 | 400 | 491 | 500 | 670 | 690 | 691 | 970 => Harmless(&[]),
        501 => Harmless(&['X', 'Y', 'Z']),
        // Where the controller keeps its accuracy: smoothing, look-ahead, exact stop, speed watch.
        51 => Harmless(&['Q', 'R', 'P', 'X', 'Y', 'Z']),
        80 => Harmless(&['P']),
        250 | 260 => Harmless(&['X', 'Y', 'Z', 'S', 'P', 'Q', 'L']),
        1030 => Harmless(&['P']),
        90 | 600 | 620 | 6010 | 6020 | 6030 | 6410 | 6420 | 6430 | 6440 | 6450 => Harmless(&[]),
        542 => Harmless(&['P']),
        1870 => Harmless(&['P', 'E']),
        // They store where the reference position is.
        281 | 301 => Harmless(&['X', 'Y', 'Z', 'A', 'B', 'C']),
        410 | 411 | 420 | 421 => Refused(
            "cutter radius compensation is not supported, as it depends on the radius and wear stored in the control: \
             have the CAM system post the compensated path (compensation in computer), or program the tool's centre line",
        ),
        160 => Refused("polar coordinates are not supported: have the CAM system post X and Y"),
        510 | 511 => {
            Refused("scaling and mirroring are not supported: have the CAM system post the final coordinates")
        }
        680 | 681 => Refused(
            "a rotated frame is not supported: turn the workpiece frame of the job, or post rotated coordinates",
        ),
        50 | 52 | 62 => Refused("splines are not supported: have the CAM system post lines and arcs"),
        650 => Refused("G65 names its macro by P, which must be in this text as O and its number"),
        660 | 661 => Refused("modal macro calls are not supported: call the macro with G65 at each place"),
        431 | 434 | 435 => {
            Refused("only G43 with an H number is supported, for a fixed tool axis: post for three axes")
        }
        922 | 923 => Refused(
            "of the G92 family, only G92 and G92.1 are supported: clear the offset with G92.1 and set it with G92",
        ),
        330 | 331 | 740 | 840 => {
            Refused("thread cutting and tapping are not supported: leave these holes out")
        }
        760 | 860 | 870 | 880 => Refused(
            "of the canned cycles, G73, G81, G82, G83, G85 and G89 are supported: post the others as plain moves",
        ),
        382..=385 => Refused("probing is not supported: delete the line"),
        70 | 960 => Refused("this is a lathe code; only milling is supported"),
        _ => Refused("this G number is not known; if it does not change the path, delete it"),
    }
}

/// The meaning of the M code with this number in tenths.
pub(super) fn m(tenths: u32) -> Meaning {
    use Meaning::{Acts, Harmless, Refused};
    match tenths {
        0 | 10 | 20 | 170 | 300 | 600 | 990 => Acts(Group::Stop),
        30 | 50 => Acts(Group::Spindle),
        60 => Acts(Group::ToolChange),
        40 => Refused("the cutting model is for a clockwise spindle: use a right-hand tool and M3"),
        960..=989 | 1980 => {
            Refused("sub-program calls are not supported: have the CAM system post one whole program")
        }
        // LinuxCNC's switch of the kinematics.
        4280 | 4290 | 4300 => Refused("this switches the kinematics: post for three axes, or use APT"),
        700..=730 => Refused("saving and restoring modes (M70 to M73) is not supported: post plain moves"),
        610 | 620 | 630 | 640 | 650 | 660 | 670 | 680 => Harmless(&['P', 'E', 'L', 'Q']),
        // Fans and heaters take S, an oriented spindle R; P is the number or the time of a function.
        1040 | 1060 | 1090 | 1400 => Harmless(&['S', 'P']),
        190 => Harmless(&['P', 'R', 'S', 'Q']),
        290 => Harmless(&['S']),
        // In every control's book an M that is not of the standard is a function of the machine.
        _ => Harmless(&['P']),
    }
}
