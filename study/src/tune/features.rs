//! Columns of the time model, a pixel: static counts of a shader.

use straightline_codegen::Compiled;
use straightline_codegen::ir::{Graph, Op};
use straightline_codegen::passes::{self, Block, Schedule, Step};
use straightline_manifest::Counts;

/// The columns. What stands behind a branch is counted apart: how many pixels take it is learned, too. Loops there, which
/// only few pixels come to, are counted apart from that, those of the filter and those of `sraa_place`.
pub const NAMES: [&str; 16] = [
    "pixels",
    "invocations",
    "reads of depth",
    "reads of normals",
    "reads of colour",
    "reads of light",
    "reads at runtime layers",
    "weights",
    "exponentials and roots",
    "arithmetic",
    "live values",
    "arithmetic behind a branch",
    "loops behind a branch",
    "loops of placing",
    "arithmetic in f16",
    "exponentials in f16",
];

/// Columns that are counted apart in `f16`.
const HALF: [(&str, &str); 2] = [
    ("exponentials and roots", "exponentials in f16"),
    ("arithmetic", "arithmetic in f16"),
];

/// Static figures of a variant, known before it is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Static {
    /// Figures by [`NAMES`], a pixel.
    pub row: Vec<f64>,
    /// Texture reads a pixel, without those of loops behind a branch.
    pub reads: f64,
    /// Statements a pixel.
    pub statements: f64,
}

impl Static {
    /// Counts a compiled variant, as it computes in `f32`.
    pub fn from_compiled(compiled: &Compiled) -> Static {
        let count = |schedule: &Schedule| passes::count_operations(&compiled.graph, schedule);
        let all = count(&compiled.schedule);
        let straight = count(&reduce_schedule(&compiled.schedule, without_loops));
        let always_run = reduce_schedule(&compiled.schedule, |_| Block::default());
        let always = count(&always_run);
        let [width, height] = compiled.graph.invocation.block_size();
        let pixels = f64::from(width * height);
        let text = compiled.text_counts();
        let statements = f64::from(text.statements) / pixels;
        let [depth, normal, colour, light] = reads_by_kind(&always);
        let (alu, calls) = (f64::from(always.alu), f64::from(always.transcendentals));
        let behind = arithmetic_cost(&straight) - arithmetic_cost(&always);
        let looped = arithmetic_cost(&all) - arithmetic_cost(&straight);
        let weights = f64::from(always.tallies.get("weight_evaluations").copied().unwrap_or(0));
        let seen = f64::from(straight.texture_reads + straight.colour_reads);
        // A branch reads what it needs: counted as if always.
        let hidden = seen - (depth + normal + colour + light);
        let figures = [
            pixels,
            1.0,
            depth,
            normal,
            colour + hidden.max(0.0),
            light,
            f64::from(runtime_layers(&compiled.graph, &always_run.body)),
            weights,
            calls,
            alu,
            f64::from(text.max_live),
            behind.max(0.0),
            looped.max(0.0),
            0.0,
            0.0,
            0.0,
        ];
        Static {
            row: figures.iter().map(|figure| figure / pixels).collect(),
            reads: seen / pixels,
            statements,
        }
    }

    /// Renames the columns to those of `f16`.
    pub fn in_half(mut self) -> Static {
        for (whole, half) in HALF {
            self.rename(whole, half);
        }
        self
    }

    /// Both passes one after the other, `place` being the kernel `sraa_place`.
    pub fn after_placing(mut self, mut place: Static) -> Static {
        place.rename("loops behind a branch", "loops of placing");
        for (own, other) in self.row.iter_mut().zip(&place.row) {
            *own += other;
        }
        self.reads += place.reads;
        self.statements += place.statements;
        self
    }

    /// Counts in one column what was counted in another.
    fn rename(&mut self, old: &str, new: &str) {
        let place = |name: &str| NAMES.iter().position(|known| *known == name);
        if let (Some(old), Some(new)) = (place(old), place(new)) {
            self.row[new] = std::mem::take(&mut self.row[old]);
        }
    }
}

/// Operations, a transcendental one as four.
fn arithmetic_cost(counts: &Counts) -> f64 {
    f64::from(counts.alu) + 4.0 * f64::from(counts.transcendentals)
}

/// Reads of depth, of normals (packed texels count as these), of colour and where that was shaded, and of albedo and parts
/// of light.
fn reads_by_kind(counts: &Counts) -> [f64; 4] {
    let of = |is: &dyn Fn(&str) -> bool| {
        let found = counts.reads.iter().filter(|(name, _)| is(name));
        f64::from(found.map(|(_, n)| n).sum::<u32>())
    };
    let depth = of(&|name| name.contains("depth"));
    let colour = of(&|name| name.starts_with("color") || name == "place");
    let light = of(&|name| name.contains("albedo") || name == "direct" || name == "rest");
    let all = of(&|_| true);
    [depth, all - depth - colour - light, colour, light]
}

/// Reads of one layer of several by a runtime index, such as the place of a pixel's shading: processors read those one by one.
fn runtime_layers(graph: &Graph, block: &Block) -> u32 {
    let of = |step: &Step| match step {
        Step::Eval(id) => {
            let node = graph.node(*id);
            let layer = node.args.get(1).filter(|_| matches!(node.op, Op::Load { .. }));
            u32::from(layer.is_some_and(|layer| graph.constant_bits(*layer).is_none()))
        }
        Step::Loop { body, .. } => runtime_layers(graph, body),
        Step::If { .. } => 0,
    };
    block.steps.iter().map(of).sum()
}

/// The schedule with `side` of what stands on either side of its branches.
fn reduce_schedule(schedule: &Schedule, side: fn(&Block) -> Block) -> Schedule {
    let mut schedule = schedule.clone();
    reduce_block(&mut schedule.body, side);
    schedule
}

fn reduce_block(block: &mut Block, side: fn(&Block) -> Block) {
    for step in &mut block.steps {
        match step {
            Step::If { then, otherwise, .. } => {
                *then = side(then);
                *otherwise = side(otherwise);
            }
            Step::Loop { body, .. } => reduce_block(body, side),
            Step::Eval(_) => {}
        }
    }
}

fn without_loops(block: &Block) -> Block {
    let mut block = block.clone();
    for step in &mut block.steps {
        match step {
            Step::If { then, otherwise, .. } => {
                *then = without_loops(then);
                *otherwise = without_loops(otherwise);
            }
            Step::Loop { body, .. } => *body = Block::default(),
            Step::Eval(_) => {}
        }
    }
    block
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_codegen::{Kernel, Settings};

    fn counted(options: &[(&str, &str)], block: [u32; 2]) -> Static {
        let settings = Settings::new()
            .set_all(options.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())))
            .block(block[0], block[1]);
        let compiled = Kernel::builtin("sraa").unwrap().compile(&settings).unwrap();
        Static::from_compiled(&compiled)
    }

    fn figure(of: &Static, name: &str) -> f64 {
        of.row[NAMES.iter().position(|known| *known == name).unwrap()]
    }

    #[test]
    fn what_a_branch_hides_is_counted_apart() {
        let plain = counted(&[], [1, 1]);
        let masked = counted(&[("mask", "branch")], [1, 1]);
        assert_eq!(figure(&plain, "arithmetic behind a branch"), 0.0);
        assert!(figure(&masked, "arithmetic behind a branch") > 50.0, "{masked:?}");
        assert!(figure(&masked, "exponentials and roots") < figure(&plain, "exponentials and roots"));
        assert_eq!(plain.reads, 35.0);
    }

    #[test]
    fn loops_behind_a_branch_are_counted_apart_and_those_of_placing_too() {
        let plain = counted(&[], [1, 1]);
        let searched = counted(&[("search", "five")], [1, 1]);
        assert_eq!(figure(&plain, "loops behind a branch"), 0.0);
        assert!(figure(&searched, "loops behind a branch") > 500.0, "{searched:?}");
        assert_eq!(figure(&searched, "arithmetic behind a branch"), 0.0);
        // A bit for each unseen sample is all that is added to what every pixel does.
        assert!(figure(&searched, "arithmetic") < 1.2 * figure(&plain, "arithmetic"));
        assert_eq!(searched.reads, plain.reads);
        assert_eq!(figure(&plain, "reads at runtime layers"), 0.0);
        let placed = counted(&[("shading", "placed")], [1, 1]);
        // Depth and normal of each of nine taps.
        assert_eq!(figure(&placed, "reads at runtime layers"), 18.0);
        assert_eq!(
            figure(&placed, "reads of colour"),
            9.0 + figure(&plain, "reads of colour")
        );

        let place = Kernel::builtin("sraa_place")
            .unwrap()
            .compile(&Settings::default())
            .unwrap();
        let place = Static::from_compiled(&place);
        let both = plain.clone().after_placing(place.clone());
        assert_eq!(figure(&both, "loops behind a branch"), 0.0);
        assert_eq!(
            figure(&both, "loops of placing"),
            figure(&place, "loops behind a branch")
        );
        assert!(figure(&both, "loops of placing") > 100.0, "{place:?}");
        assert_eq!(figure(&both, "invocations"), 2.0);
        assert_eq!(both.reads, plain.reads + place.reads);
    }

    #[test]
    fn half_precision_moves_arithmetic_and_nothing_else() {
        let whole = counted(&[], [1, 1]);
        let half = whole.clone().in_half();
        assert_eq!(figure(&half, "arithmetic"), 0.0);
        assert_eq!(figure(&half, "arithmetic in f16"), figure(&whole, "arithmetic"));
        assert_eq!(half.row.iter().sum::<f64>(), whole.row.iter().sum::<f64>());
    }

    #[test]
    fn a_block_shares_reads_and_figures_are_a_pixel() {
        let (one, four) = (counted(&[], [1, 1]), counted(&[], [2, 2]));
        assert_eq!(figure(&four, "pixels"), 1.0);
        assert_eq!(figure(&four, "invocations"), 0.25);
        assert!(four.reads < one.reads);
        assert_eq!(figure(&one, "weights"), figure(&four, "weights"));
        assert_eq!(
            figure(&counted(&[("metric", "depth")], [1, 1]), "reads of normals"),
            0.0
        );
    }
}
