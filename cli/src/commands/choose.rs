//! `choose`: the candidates of a shader, compared by the compilers of GPUs that need not be there.

use super::study::isa::start_compiler;
use crate::args::{ChooseArgs, Gpus};
use crate::failure::Failure;
use std::path::Path;
use straightline_codegen::files::{read_text, shorten};
use straightline_isa::{Gpu, IsaError};
use straightline_manifest::Manifest;
use straightline_manifest::plan::Plan;
use straightline_runtime::{Candidate, Choices, Shader};
use straightline_study::isa::spirv_by_naga;
use straightline_table::{Column, Table};

/// Most bytes of a list of candidates, a manifest or a text.
const MAX_BYTES: u64 = 1 << 24;

/// A candidate that was read.
struct Read {
    name: String,
    /// Manifest, and WGSL.
    files: [String; 2],
    entry: String,
    spirv: Vec<u8>,
    /// Pixels of an invocation.
    pixels: f64,
}

/// Compiles each candidate for each GPU, prints the costs, and writes the cheapest of each vendor.
pub fn choose_candidates(args: &ChooseArgs) -> Result<(), Failure> {
    let read = read_candidates(&args.list)?;
    let shaders: Result<Vec<_>, _> = read
        .iter()
        .map(|one| Shader::from_json(&one.files[0], &one.files[1]))
        .collect();
    let shaders = shaders.map_err(Failure::from_error)?;
    let candidates = read.iter().zip(&shaders);
    let candidates: Vec<_> = candidates
        .map(|(one, shader)| Candidate {
            name: &one.name,
            shader,
        })
        .collect();
    let mut choices = match &args.out {
        Some(out) => Choices::read(out).map_err(Failure::from_error)?,
        None => Choices::new(),
    };
    let costs = ask_compilers(&read, &Gpus::distinct(&args.isa))?;
    for of_vendor in costs.chunk_by(|a, b| a.0.vendor_name() == b.0.vendor_name()) {
        let gpu = of_vendor[0].0;
        let Some(vendor) = gpu.vendor_id() else { continue };
        if let Some(cheapest) = find_cheapest(of_vendor) {
            let name = &read[cheapest].name;
            choices.add_for_vendor(vendor, &candidates, name, &list_costs(&read, of_vendor));
            outln!("{}: {name}", gpu.vendor_title());
        } else {
            outln!("{}: no candidate has a cost on all of its GPUs", gpu.vendor_title());
        }
    }
    let columns = costs.iter().fold(
        Table::of(read.iter().enumerate()).column(Column::from("candidate").left(), |(_, one)| one.name.as_str()),
        |table, (gpu, costs)| {
            table.column(format!("{gpu}, {}", gpu.cost_unit()), |(k, _)| {
                costs[*k].map(|cost| straightline_table::Cell::fixed(cost, 1))
            })
        },
    );
    outln!("\n{}", columns.finish().to_text());
    match &args.out {
        Some(out) => choices.write(out).map_err(Failure::from_error),
        None => Ok(()),
    }
}

/// Reads `NAME.candidates.txt`, and the files beside it that it names.
fn read_candidates(list: &Path) -> Result<Vec<Read>, Failure> {
    let read = |path: &Path| {
        read_text(path, MAX_BYTES)
            .map_err(|error| Failure::Failed(format!("cannot read `{}`: {error}", path.display())))
    };
    let lines = read(list)?;
    let lines = lines.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| {
        let Some((name, stem)) = line.split_once(' ').filter(|(_, stem)| !stem.contains(['/', '\\'])) else {
            return Err(Failure::Failed(format!(
                "`{}` is no list of candidates: `{}` is not a name and the stem of a file; `build.rs` writes such a list, \
                 NAME.candidates.txt, beside the shaders of a kernel with `.candidate(..)`",
                list.display(), shorten(line)
            )));
        };
        let file = |extension: &str| read(&list.with_file_name(format!("{stem}.{extension}")));
        let files = [file("json")?, file("wgsl")?];
        let manifest = Manifest::from_json(&files[0]).map_err(Failure::from_error)?;
        let plan = Plan::from_manifest(&manifest).map_err(Failure::from_error)?;
        Ok(Read {
            name: name.to_owned(),
            spirv: spirv_by_naga(&files[1]).map_err(|why| Failure::Failed(format!("`{stem}.wgsl`: {why}")))?,
            entry: manifest.entry_point,
            pixels: f64::from(plan.block[0] * plan.block[1]),
            files,
        })
    }).collect()
}

/// A GPU with the cost of a pixel by each candidate; `None` where its compiler refuses it, or counts instructions of loops.
type Costs = (Gpu, Vec<Option<f64>>);

fn ask_compilers(read: &[Read], gpus: &[Gpu]) -> Result<Vec<Costs>, Failure> {
    let ask = |gpu: &Gpu| -> Result<Costs, IsaError> {
        let mut compiler = start_compiler(*gpu)?;
        let costs = read.iter().map(|one| match compiler.compile(&one.spirv, &one.entry) {
            Ok(report) => Ok(report.figures.cost().map(|cost| cost as f64 / one.pixels)),
            Err(IsaError::Shader(..)) => Ok(None),
            Err(other) => Err(other),
        });
        Ok((*gpu, costs.collect::<Result<_, _>>()?))
    };
    gpus.iter().map(|gpu| ask(gpu).map_err(Failure::from_error)).collect()
}

/// Returns the candidate whose costs, each as a ratio to the smallest one on its GPU, have the smallest product. Those without a
/// cost on some GPU are left out.
fn find_cheapest(costs: &[Costs]) -> Option<usize> {
    let count = costs.first()?.1.len();
    let product = |k: usize| {
        costs.iter().try_fold(1.0, |product, (_, of)| {
            let smallest = of.iter().flatten().copied().fold(f64::INFINITY, f64::min);
            Some(product * of[k]? / smallest)
        })
    };
    let known = (0..count).filter_map(|k| Some((k, product(k)?)));
    known.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
}

/// Costs for people: `amd:navi21 default 543.0 looped 601.5 cycles`.
fn list_costs(read: &[Read], costs: &[Costs]) -> String {
    let each = costs.iter().map(|(gpu, of)| {
        let of = read
            .iter()
            .zip(of)
            .filter_map(|(one, cost)| Some(format!("{} {:.1}", one.name, (*cost)?)));
        format!("{gpu} {} {}", of.collect::<Vec<_>>().join(" "), gpu.cost_unit())
    });
    each.collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vendor_s_candidate_is_the_cheapest_over_its_gpus() {
        let gpus: Vec<Gpu> = Gpu::all().take(2).collect();
        let costs = |of: [[Option<f64>; 3]; 2]| -> Vec<Costs> { gpus.iter().copied().zip(of.map(Vec::from)).collect() };
        let some = |a, b, c| [Some(a), Some(b), Some(c)];
        // The second one is worse on one GPU, but never by much.
        assert_eq!(
            find_cheapest(&costs([some(100.0, 110.0, 200.0), some(200.0, 100.0, 90.0)])),
            Some(1)
        );
        assert_eq!(
            find_cheapest(&costs([[Some(1.0), None, None], some(3.0, 1.0, 1.0)])),
            Some(0)
        );
        assert_eq!(find_cheapest(&costs([[None; 3], some(1.0, 1.0, 1.0)])), None);
    }
}
