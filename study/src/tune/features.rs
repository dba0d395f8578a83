//! What a shader's static counts say of its time: the columns of the model, a pixel.

use straightline_codegen::Compiled;
use straightline_codegen::passes::{self, Block, Schedule, Step};
use straightline_manifest::Counts;

/// The columns. What stands behind a branch is counted apart: how many pixels take it is learned, too.
pub const NAMES: [&str; 12] = [
    "pixels",
    "invocations",
    "reads of depth",
    "reads of normals",
    "reads of colour",
    "weights",
    "exponentials and roots",
    "arithmetic",
    "live values",
    "arithmetic behind a branch",
    "arithmetic in f16",
    "exponentials in f16",
];

/// What is counted in another column in `f16`.
const HALF: [(&str, &str); 2] = [
    ("exponentials and roots", "exponentials in f16"),
    ("arithmetic", "arithmetic in f16"),
];

/// What is known of a variant before it is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Static {
    /// Figures by [`NAMES`], a pixel.
    pub row: Vec<f64>,
    /// Texture reads a pixel.
    pub reads: f64,
    /// Statements a pixel.
    pub statements: f64,
}

impl Static {
    /// Counts a compiled variant, as it computes in `f32`.
    pub fn of(compiled: &Compiled) -> Static {
        let all = passes::count(&compiled.graph, &compiled.schedule);
        let always = passes::count(&compiled.graph, &without_branches(&compiled.schedule));
        let [width, height] = compiled.graph.invocation.pixels();
        let pixels = f64::from(width * height);
        let statements = f64::from(compiled.statements()) / pixels;
        let (depth, normal, colour) = reads(&always);
        let (alu, calls) = (f64::from(always.alu), f64::from(always.transcendentals));
        let behind = f64::from(all.alu + 4 * all.transcendentals) - f64::from(always.alu + 4 * always.transcendentals);
        let weights = f64::from(always.tallies.get("weight_evaluations").copied().unwrap_or(0));
        // A branch reads what it needs: counted as if always.
        let hidden = f64::from(all.texture_reads + all.colour_reads) - (depth + normal + colour);
        let figures = [
            pixels,
            1.0,
            depth,
            normal,
            colour + hidden.max(0.0),
            weights,
            calls,
            alu,
            f64::from(all.max_live),
            behind.max(0.0),
            0.0,
            0.0,
        ];
        Static {
            row: figures.iter().map(|figure| figure / pixels).collect(),
            reads: f64::from(all.texture_reads + all.colour_reads) / pixels,
            statements,
        }
    }

    /// The same computed in `f16`.
    pub fn in_half(mut self) -> Static {
        for (whole, half) in HALF {
            let place = |name: &str| NAMES.iter().position(|known| *known == name);
            if let (Some(whole), Some(half)) = (place(whole), place(half)) {
                self.row[half] = std::mem::take(&mut self.row[whole]);
            }
        }
        self
    }
}

/// Reads of depth, of normals (packed texels count as these), and of colour.
fn reads(counts: &Counts) -> (f64, f64, f64) {
    let of = |is: &dyn Fn(&str) -> bool| {
        let found = counts.reads.iter().filter(|(name, _)| is(name));
        f64::from(found.map(|(_, n)| n).sum::<u32>())
    };
    let depth = of(&|name| name.contains("depth"));
    let colour = of(&|name| name.starts_with("color"));
    let all = of(&|_| true);
    (depth, all - depth - colour, colour)
}

/// The schedule with nothing on either side of its branches.
fn without_branches(schedule: &Schedule) -> Schedule {
    let mut schedule = schedule.clone();
    strip(&mut schedule.body);
    schedule
}

fn strip(block: &mut Block) {
    for step in &mut block.steps {
        match step {
            Step::If { then, otherwise, .. } => {
                *then = Block::default();
                *otherwise = Block::default();
            }
            Step::Loop { body, .. } => strip(body),
            Step::Eval(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_codegen::{Kernel, Settings};

    fn counted(options: &[(&str, &str)], block: [u32; 2]) -> Static {
        let settings = Settings {
            options: options
                .iter()
                .map(|(n, v)| ((*n).to_owned(), (*v).to_owned()))
                .collect(),
            block,
            ..Settings::default()
        };
        let compiled = Kernel::builtin("sraa").unwrap().compile(&settings).unwrap();
        Static::of(&compiled)
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
