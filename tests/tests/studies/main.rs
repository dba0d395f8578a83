//! Studies and documents: what they measure, and whether tables and sentences follow the records.

#[path = "../common/mod.rs"]
mod common;
mod plain;
mod quality;
mod readme;
mod steps;
mod sweep;
mod tune;
