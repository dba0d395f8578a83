//! Every function of floats at the edges of its domain, on every road to a driver: WGSL through wgpu; GLSL, SPIR-V and HLSL
//! without it. What rustc computes is what the interpreter computes bit by bit, and what lavapipe and SwiftShader compute
//! within the accuracy that docs/semantics.md states.

mod compare;
mod functions;
mod kernels;
mod report;
mod rights;
mod roads;

use kernels::Table;
use rayon::prelude::*;
use report::Report;
use roads::{INTERPRETER, Road};
use std::time::Instant;

#[test]
fn functions_at_their_edges_on_every_road() {
    let begin = Instant::now();
    let mut report = Report::default();
    let tables = kernels::tables();
    let made: Vec<_> = tables.par_iter().map(Table::make).collect();
    for (table, made) in tables.iter().zip(&made) {
        let found = made.as_ref().map_err(Clone::clone);
        report.add(
            INTERPRETER,
            found.and_then(|made| table.mismatches_of_interpreter(made)),
        );
    }
    let roads = Road::all().unwrap_or_else(|why| panic!("{why}"));
    let found: Vec<_> = roads
        .par_iter()
        .map(|road| {
            let each = tables
                .iter()
                .zip(&made)
                .filter_map(|(table, made)| Some((table, made.as_ref().ok()?)));
            let each = each.map(|(table, made)| {
                road.run(made)
                    .map(|pictures| table.mismatches(&road.to_string(), &pictures))
            });
            each.collect::<Vec<_>>()
        })
        .collect();
    for (road, found) in roads.iter().zip(found) {
        found.into_iter().for_each(|found| report.add(&road.to_string(), found));
    }
    println!(
        "{} functions in {} kernels, {} values on each of {} roads, in {:.1} s",
        functions::FUNCTIONS.len(),
        tables.len(),
        tables.iter().map(Table::values).sum::<usize>(),
        roads.len(),
        begin.elapsed().as_secs_f64()
    );
    println!("{}", report.finish().unwrap_or_else(|why| panic!("{why}")));
}
