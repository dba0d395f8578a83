//! The definitions against numbers worked out by hand, and the dependencies of this crate.

mod by_hand;
mod independent;
