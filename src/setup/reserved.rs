//! Names that mean something to a controller already, so that no program may have them.

use crate::setup::Controller;

/// KRL's words, and programs that a KUKA controller has.
const KUKA: &str = "\
    BAS CELL SPS IR_STOPM INITMOV HOME TOOL BASE FRAMES MAIN DEF DEFDAT DEFFCT END ENDDAT \
    ENDFCT LIN PTP CIRC SLIN SPTP SCIRC SPLINE HALT WAIT IF THEN ELSE ENDIF FOR ENDFOR LOOP \
    ENDLOOP WHILE ENDWHILE REPEAT UNTIL SWITCH CASE DEFAULT ENDSWITCH GOTO RETURN EXIT \
    CONTINUE INTERRUPT TRIGGER DECL EXT INT REAL BOOL CHAR STRUC ENUM FRAME POS E6POS AXIS \
    E6AXIS LOAD SIGNAL CONST GLOBAL PUBLIC IMPORT TRUE FALSE AND OR NOT EXOR";

/// RAPID's words, and data of the package.
const ABB: &str = "\
    main tMill wPart zMill tool0 wobj0 load0 fine MODULE ENDMODULE SYSMODULE PROC ENDPROC FUNC \
    ENDFUNC TRAP ENDTRAP VAR PERS CONST TASK LOCAL RECORD ENDRECORD ALIAS IF THEN ELSE ELSEIF \
    ENDIF FOR FROM TO STEP DO ENDFOR WHILE ENDWHILE TEST CASE DEFAULT ENDTEST GOTO RETURN EXIT \
    RAISE RETRY TRYNEXT CONNECT WITH ERROR UNDO BACKWARD AND OR NOT XOR DIV MOD TRUE FALSE \
    INOUT NOSTEPIN VIEWONLY READONLY NOVIEW STOP MoveL MoveJ MoveC";

/// VAL3's words, and programs and data of the package.
const STAUBLI: &str = "\
    start stop begin end call if else elseIf endIf for endFor while endWhile do until switch \
    case endSwitch return and or not world flange fPart tMill jStart mMove mCut mStop";

/// Words of a controller's language and names that it or the package has.
pub(super) fn words(controller: Controller) -> Vec<&'static str> {
    let words = match controller {
        Controller::Kuka => KUKA,
        Controller::Abb => ABB,
        Controller::Staubli => STAUBLI,
        Controller::Fanuc | Controller::Gcode | Controller::Apt | Controller::Csv => "",
    };
    words.split_whitespace().collect()
}
