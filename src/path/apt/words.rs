//! Known major words of APT that make no path: harmless ones, and ones that would change it.
//!
//! Sources: ISO 4343:2000 (NC processor output, post processor commands), manuals of PTC and
//! Siemens, and CATIA's output.

/// Words that neither move the tool nor change its path: listed only.
pub(super) const HARMLESS: [&str; 50] = [
    "AIR",
    "AUTOPS",
    "BREAK",
    "CHECK",
    "CLAMP",
    "CLEARP",
    "CLPRNT",
    "CLRSRF",
    "COOLNT",
    "CUTTER",
    "DISPLY",
    "END",
    "END-OF-PATH",
    "INTOL",
    "LEADER",
    "LETTER",
    "LINTOL",
    "LOAD",
    "LOADTL",
    "MACHIN",
    "MACHTL",
    "MAXANG",
    "MAXDP",
    "MAXVEL",
    "NOPOST",
    "NUMPTS",
    "OPSTOP",
    "OUTTOL",
    "OVRIDE",
    "PAINT",
    "PARTNO",
    "PIVOTZ",
    "PPRINT",
    "PRINT",
    "REMARK",
    "RESET",
    "REWIND",
    "SAFETY",
    "SELCTL",
    "SELECT",
    "SEQNO",
    "SETUP",
    "STOP",
    "TLDATA",
    "TMARK",
    "TOLER",
    "TOOL PATH",
    "TOOLNO",
    "TPRINT",
    "TRNTYP",
];

/// Whether a word neither moves the tool nor changes its path. SolidWorks CAM has many of one kind:
/// `CSI_SET_OFFSET` and the like.
pub(super) fn is_harmless(word: &str) -> bool {
    HARMLESS.contains(&word) || word.starts_with("CSI_SET_")
}

/// Words whose text goes to the controller unchanged: listed with a remark, because it may move the
/// tool.
pub(super) const CONTROLLER: [&str; 3] = ["AUXFUN", "INSERT", "PREFUN"];

/// Words that the reader supports, for suggestions.
pub(super) const READ: [&str; 23] = [
    "CIRCLE", "CSYS", "CUTCOM", "CYCLE", "DELAY", "DWELL", "FEDRAT", "FINI", "FROM", "GOFWD", "GOHOME",
    "GOTO", "INDIRP", "INDIRV", "MOVARC", "MSYS", "MULTAX", "ORIGIN", "RAPID", "SPINDL", "TLAXIS", "TLON",
    "UNITS",
];

/// What to do about a word that changes the path in an unsupported way.
pub(super) fn refused(word: &str) -> Option<&'static str> {
    Some(match word {
        "TRACUT" | "TRANS" | "COPY" | "ROTATE" | "MIRROR" | "SCALE" | "REFSYS" | "MATRIX" | "CSYS" => {
            "transformed copies are not supported: have the CAM system write the actual points"
        }
        "INDEX" | "ROTABL" | "ROTHED" | "TLROT" | "HEAD" | "PIVOT" => {
            "rotary axes are not supported: have the CAM system write GOTO/x,y,z,i,j,k in the workpiece's frame (MULTAX/ON)"
        }
        "CUTCOM" => {
            "cutter compensation changes the path: have the CAM system compensate, and write the tool centre's path"
        }
        "CYCLE" | "PITCH" | "THREAD" | "HELIX" => {
            "this cycle is not supported, only CYCLE/DRILL,DEPTH,d,MMPM,f,CLEAR,c, \
             DEEP or BRKCHP with STEP,s, and FACE with DWELL,t: \
             have the CAM system write other cycles as GOTO (\"expand cycles\")"
        }
        "GODLTA" | "MODE" => "moves are absolute here: write GOTO/x,y,z",
        "GO" | "GOLFT" | "GORGT" | "GOBACK" | "GOUP" | "GODOWN" | "OFFSET" | "PSIS" | "THICK" | "TLONPS"
        | "TLOFPS" => {
            "part geometry is not supported: have the CAM system write arcs as CIRCLE or as points, in CLDATA (GOTO)"
        }
        "RETRCT" | "RETURN" | "GOCLER" => {
            "a retract to a plane is not supported: write RAPID and a GOTO instead"
        }
        "NURBS" | "SPLINE" | "BSPLINE" | "POLY" | "KNOT" | "CNTRL" => {
            "splines are not supported: have the CAM system write lines and arcs (GOTO and CIRCLE)"
        }
        "ARCDAT" | "ARCMOV" | "ARCSLP" => {
            "this kind of curve is not supported: have the CAM system write CIRCLE or points"
        }
        "MACRO" | "CALL" | "TERMAC" | "LOOPST" | "LOOPND" | "IF" | "JUMPTO" | "DO" | "INCLUD" | "READ"
        | "RESERV" => "programs within the program are not supported: have the CAM system write the points",
        _ => return None,
    })
}

/// The most similar known word.
pub(super) fn nearest(word: &str) -> Option<&'static str> {
    // No APT word is that long, and comparing a whole file of another kind would be slow.
    if word.len() > 30 {
        return None;
    }
    let known = READ.iter().chain(&HARMLESS).chain(&CONTROLLER);
    known
        .map(|candidate| (strsim::jaro_winkler(word, candidate), *candidate))
        .filter(|(likeness, _)| *likeness > 0.85)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}
