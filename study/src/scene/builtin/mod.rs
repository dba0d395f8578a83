//! x
use super::*;
/// x
pub fn builtin() -> Scene {
    todo!()
}
