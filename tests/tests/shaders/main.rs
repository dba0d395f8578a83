//! Shaders: in every language and stage, as drivers, compilers and engines take them.

mod bare;
mod bindings;
#[path = "../common/mod.rs"]
mod common;
mod constants;
mod drift;
mod edges;
mod edges_of_functions;
mod engines;
mod exact;
mod gathers;
mod gl;
mod gpu;
mod half;
mod hlsl;
mod images;
mod immediates;
mod opengl;
mod origin;
mod outputs;
mod overrides;
mod passes;
mod passthrough;
mod plain;
mod resolution;
mod shared;
mod textures;
mod workgroups;
mod writes;
mod yardstick;
