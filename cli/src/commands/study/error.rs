//! `study error`.

use super::Progress;
use crate::args::{CommonArgs, ErrorArgs};
use crate::failure::Failure;

/// To be written.
pub fn run(_common: &CommonArgs, _args: &ErrorArgs, _progress: &mut Progress) -> Result<(), Failure> {
    Err(Failure::Failed("`study error` is not there yet".to_owned()))
}
