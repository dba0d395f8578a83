//! `study loops`.

use super::Progress;
use crate::args::{CommonArgs, LoopsArgs};
use crate::failure::Failure;

/// To be written.
pub fn run(_common: &CommonArgs, _args: &LoopsArgs, _progress: &mut Progress) -> Result<(), Failure> {
    Err(Failure::Failed("`study loops` is not there yet".to_owned()))
}
