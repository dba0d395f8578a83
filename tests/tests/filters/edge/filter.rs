//! A setting of a filter: as a kernel, natively, and by definition.

use super::world::{World, pixels};
use straightline_bench::execute::Inputs;
use straightline_codegen::{Compiled, Kernel, Settings, Unroll};
use straightline_kernels::edge::{Depth, Form, NonFinite, Normals, Output, Stalker, TabulaRasa, stalker, tabula_rasa};
use straightline_kernels::prelude::*;
use straightline_oracle::oracle::edge as oracle;

/// Values by the names of options.
type Named<T> = Vec<(&'static str, T)>;

/// A filter with its setting.
#[derive(Clone, Copy, Debug)]
pub enum Filter {
    Stalker(Stalker),
    TabulaRasa(TabulaRasa),
}

/// Either form with one of the two.
fn non_finite(form: Form) -> NonFinite {
    match form {
        Form::Paper => NonFinite::Spread,
        Form::Corrected => NonFinite::Skip,
    }
}

fn word(non_finite: NonFinite) -> &'static str {
    match non_finite {
        NonFinite::Spread => "spread",
        NonFinite::Skip => "skip",
    }
}

impl Filter {
    /// Every choice of both, with numbers that divide `World::surfaces` in two.
    pub fn all() -> Vec<Filter> {
        let mut all = Vec::new();
        for form in [Form::Paper, Form::Corrected] {
            for output in [Output::Antialias, Output::Edges] {
                for (depth, normals, normal_weight, depth_weight) in [
                    (Depth::Projected, Normals::Float, 1.0, 1.0),
                    (Depth::Linear, Normals::Unorm, 0.75, 2.0),
                    (Depth::Linear, Normals::Octahedral, 0.375, 0.5),
                ] {
                    all.push(Filter::Stalker(Stalker {
                        form,
                        output,
                        depth,
                        normals,
                        normal_weight,
                        depth_weight,
                        non_finite: non_finite(form),
                        normal_barrier: 0.9,
                        depth_barrier: 0.004,
                        kernel: 0.75,
                    }));
                }
                for normals in [Normals::Float, Normals::Unorm, Normals::Octahedral] {
                    all.push(Filter::TabulaRasa(TabulaRasa {
                        form,
                        output,
                        normals,
                        non_finite: non_finite(form),
                        depth_sensibility: 9.0,
                        normal_sensibility: 3.0,
                        weight: 0.8,
                    }));
                }
            }
        }
        all
    }

    pub fn name(&self) -> &'static str {
        match self {
            Filter::Stalker(_) => "stalker",
            Filter::TabulaRasa(_) => "tabula_rasa",
        }
    }

    pub fn title(&self) -> &'static str {
        match self {
            Filter::Stalker(_) => "S.T.A.L.K.E.R.",
            Filter::TabulaRasa(_) => "Tabula Rasa",
        }
    }

    pub fn output(&self) -> Output {
        match self {
            Filter::Stalker(cfg) => cfg.output,
            Filter::TabulaRasa(cfg) => cfg.output,
        }
    }

    pub fn normals(&self) -> Normals {
        match self {
            Filter::Stalker(cfg) => cfg.normals,
            Filter::TabulaRasa(cfg) => cfg.normals,
        }
    }

    /// Choices, and numbers.
    pub fn options(&self) -> (Named<String>, Named<f32>) {
        let form = |form| match form {
            Form::Paper => "paper",
            Form::Corrected => "corrected",
        };
        let output = match self.output() {
            Output::Antialias => "antialias",
            Output::Edges => "edges",
        };
        let normals = match self.normals() {
            Normals::Float => "float",
            Normals::Unorm => "unorm",
            Normals::Octahedral => "octahedral",
        };
        match self {
            Filter::Stalker(cfg) => {
                let depth = match cfg.depth {
                    Depth::Projected => "projected",
                    Depth::Linear => "linear",
                };
                (
                    vec![
                        ("form", form(cfg.form).to_owned()),
                        ("output", output.to_owned()),
                        ("depth", depth.to_owned()),
                        ("normals", normals.to_owned()),
                        ("non-finite", word(cfg.non_finite).to_owned()),
                        ("normal-weight", cfg.normal_weight.to_string()),
                        ("depth-weight", cfg.depth_weight.to_string()),
                    ],
                    vec![
                        ("normal_barrier", cfg.normal_barrier),
                        ("depth_barrier", cfg.depth_barrier),
                        ("kernel", cfg.kernel),
                    ],
                )
            }
            Filter::TabulaRasa(cfg) => (
                vec![
                    ("form", form(cfg.form).to_owned()),
                    ("output", output.to_owned()),
                    ("normals", normals.to_owned()),
                    ("non-finite", word(cfg.non_finite).to_owned()),
                ],
                vec![
                    ("depth_sensibility", cfg.depth_sensibility),
                    ("normal_sensibility", cfg.normal_sensibility),
                    ("weight", cfg.weight),
                ],
            ),
        }
    }

    /// The kernel as the generator has it, its numbers set at run time.
    pub fn compile(&self, unroll: Unroll) -> Compiled {
        let (choices, _) = self.options();
        let choices = choices.into_iter().map(|(k, v)| (k.to_owned(), v));
        compile(self.name(), choices.collect(), unroll)
    }

    /// Inputs of the filter, numbers included.
    pub fn inputs(&self, world: &World) -> Inputs {
        let (_, numbers) = self.options();
        numbers.iter().fold(world.inputs(), |inputs, (k, v)| {
            inputs.with_uniform(k, &[f64::from(*v)])
        })
    }

    pub fn native(&self, world: &World) -> Vec<[f32; 4]> {
        let World {
            depth,
            stored: normal,
            color,
            ..
        } = world;
        let linear = Sampler::default();
        let pixel = |at| match self {
            Filter::Stalker(cfg) => stalker(cfg, depth, normal, color, &linear, at),
            Filter::TabulaRasa(cfg) => tabula_rasa(cfg, depth, normal, color, &linear, at),
        };
        pixels(depth.size()).map(|at| pixel(at).to_array()).collect()
    }

    /// Edge strength of each pixel, and the filtered colours, by definition.
    pub fn exact(&self, world: &World) -> (Vec<oracle::Edge>, Vec<[f64; 4]>) {
        let (edges, colors) = match self {
            Filter::Stalker(cfg) => {
                let exact = oracle::Stalker {
                    printed: cfg.form == Form::Paper,
                    linear_depth: cfg.depth == Depth::Linear,
                    normal_barrier: cfg.normal_barrier.into(),
                    depth_barrier: cfg.depth_barrier.into(),
                    normal_weight: cfg.normal_weight.into(),
                    depth_weight: cfg.depth_weight.into(),
                    kernel: cfg.kernel.into(),
                };
                (
                    exact.edges(&world.geometry()),
                    exact.filter_picture(&world.geometry(), &world.color),
                )
            }
            Filter::TabulaRasa(cfg) => {
                let exact = oracle::TabulaRasa {
                    printed: cfg.form == Form::Paper,
                    depth_sensibility: cfg.depth_sensibility.into(),
                    normal_sensibility: cfg.normal_sensibility.into(),
                    weight: cfg.weight.into(),
                };
                (
                    exact.edges(&world.geometry()),
                    exact.filter_picture(&world.geometry(), &world.color),
                )
            }
        };
        match self.output() {
            Output::Antialias => (edges, colors),
            Output::Edges => {
                let grey = edges.iter().map(|e| [e.weight, e.weight, e.weight, 1.0]);
                let grey = grey.collect();
                (edges, grey)
            }
        }
    }

    /// Edge strength that the kernel finds at `at`.
    pub fn edge(&self, world: &World, at: IVec2) -> f32 {
        self.native(world)[(at.y as u32 * world.depth.size().x + at.x as u32) as usize][0]
    }
}

pub fn compile(kernel: &str, options: Vec<(String, String)>, unroll: Unroll) -> Compiled {
    let settings = Settings::new().set_all(options).unroll(unroll);
    Kernel::builtin(kernel)
        .and_then(|k| k.compile(&settings))
        .unwrap_or_else(|e| panic!("{e}"))
}
