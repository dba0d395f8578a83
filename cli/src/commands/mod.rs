//! One room a command.

pub mod adapters;
pub mod budget;
pub mod capture;
pub mod compare;
pub mod demo;
pub mod emit;
pub mod explain;
pub mod list;
pub mod page;
pub mod quads;
pub mod resolve;
pub mod run;
pub mod scenes;
pub mod study;
pub mod tune;
