//! The definitions against numbers worked out by hand, and what this crate depends on.

mod by_hand;
mod independent;
