//! The benchmark's entry points for the page: `page/worker.js` times them with the browser's clock.

use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::poses::{self, Poses};
use crate::stages::{STAGES, Stages};

/// The stages of a job.
#[wasm_bindgen]
pub struct StageBench(Stages);

#[wasm_bindgen]
impl StageBench {
    /// The default job with roughly this many samples.
    #[wasm_bindgen(constructor)]
    pub fn new(samples: usize) -> Result<StageBench, JsError> {
        Ok(Self(Stages::new(samples)?))
    }

    /// Names of the stages.
    pub fn names() -> Vec<String> {
        STAGES.iter().map(|(name, _)| (*name).to_owned()).collect()
    }

    /// Runs one stage.
    pub fn work(&self, stage: usize) {
        if let Some((_, work)) = STAGES.get(stage) {
            work(&self.0);
        }
    }
}

/// Kinematics over many poses.
#[wasm_bindgen]
pub struct PoseBench(Poses);

#[wasm_bindgen]
impl PoseBench {
    /// The default robot.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Result<PoseBench, JsError> {
        Ok(Self(Poses::new()?))
    }

    /// Names of the operations timed at every pose.
    pub fn names() -> Vec<String> {
        poses::WORK.iter().map(|(name, _)| (*name).to_owned()).collect()
    }

    /// Runs one operation at every pose.
    pub fn work(&self, index: usize) {
        if let Some((_, work)) = poses::WORK.get(index) {
            work(&self.0);
        }
    }
}
