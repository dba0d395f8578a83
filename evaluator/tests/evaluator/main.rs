//! The evaluator alone: graphs as text, and the rules that every graph keeps.

mod cases;
mod filetests;
mod verify;
