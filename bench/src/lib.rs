//! Execution of compiled kernels on images, by the interpreter or on a GPU, and its timing.

pub mod execute;
