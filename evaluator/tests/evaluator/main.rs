//! The evaluator alone: graphs as text, the rules that every graph keeps, and what becomes of loops.

mod cases;
mod filetests;
mod loops;
mod names;
mod verify;
