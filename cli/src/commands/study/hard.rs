//! `study hard`.

use super::Progress;
use crate::args::{CommonArgs, HardArgs};
use crate::failure::Failure;

/// To be written.
pub fn run(_common: &CommonArgs, _args: &HardArgs, _progress: &mut Progress) -> Result<(), Failure> {
    Err(Failure::Failed("`study hard` is not there yet".to_owned()))
}
