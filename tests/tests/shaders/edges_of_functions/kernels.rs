//! Kernels of sixteen functions each, in four targets of four floats.

use crate::edges_of_functions::compare::{self, Mismatch};
use crate::edges_of_functions::functions::{FUNCTIONS, Function};
use crate::edges_of_functions::roads::INTERPRETER;
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::{Compiled, EmitOptions, Format, Kernel, Settings, Stage};
use straightline_kernels::prelude::*;
use straightline_tests::bare::{LANGUAGES, Shader};
use straightline_tests::edges::{FEW, FLOATS};

/// Functions of a kernel.
const EACH: usize = 16;

/// A function, some of whose arguments may be constants.
#[derive(Clone)]
pub struct Column {
    function: &'static Function,
    constants: [Option<f32>; 3],
}

impl Column {
    /// The function with its constants in place.
    pub fn name(&self) -> String {
        let given = ["x", "y", "z"].iter().zip(self.constants);
        let given: Vec<String> = given
            .filter_map(|(name, c)| Some(format!("{name} = {:?}", c?)))
            .collect();
        match given.is_empty() {
            true => self.function.text.to_owned(),
            false => format!("{} with {}", self.function.text, given.join(", ")),
        }
    }

    /// Text as a block of the kernel.
    fn block(&self) -> String {
        let given = ["x", "y", "z"].iter().zip(self.constants);
        let lets = given.filter_map(|(name, c)| Some(format!("let {name} = {}; ", literal(c?))));
        format!("{{ {}{} }}", lets.collect::<String>(), self.function.text)
    }

    fn arguments(&self, texel: Vec4) -> [f32; 3] {
        let texel = texel.to_array();
        std::array::from_fn(|k| self.constants[k].unwrap_or(texel[k]))
    }
}

/// A float as Rust.
fn literal(x: f32) -> String {
    match x {
        _ if x.is_nan() => "f32::NAN".to_owned(),
        f32::INFINITY => "f32::INFINITY".to_owned(),
        f32::NEG_INFINITY => "f32::NEG_INFINITY".to_owned(),
        _ => format!("{x:?}f32"),
    }
}

/// A kernel, and the arguments that it is run on.
pub struct Table {
    columns: Vec<Column>,
    inputs: Inputs,
}

/// A compiled kernel and its texts.
pub struct Made<'t> {
    /// The kernel.
    pub compiled: Compiled,
    /// Texts of the shader.
    pub emitted: Emitted,
    /// The texts that are run without wgpu, in the order of `LANGUAGES`.
    pub shaders: Vec<Shader>,
    /// Inputs of the shader.
    pub inputs: &'t Inputs,
}

/// All tables: functions of runtime values by the number of their arguments, and functions with a constant.
pub fn tables() -> Vec<Table> {
    let mut tables = Vec::new();
    for arity in 1..=3 {
        let of_arity = FUNCTIONS.iter().filter(|function| function.arity == arity);
        let columns: Vec<Column> = of_arity
            .map(|function| Column {
                function,
                constants: [None; 3],
            })
            .collect();
        tables.extend(columns.chunks(EACH).map(|columns| Table {
            columns: columns.to_vec(),
            inputs: arguments(arity),
        }));
    }
    for function in FUNCTIONS.iter().filter(|function| function.constants) {
        for place in 0..function.arity {
            let column = |c: &f32| {
                let mut constants = [None; 3];
                constants[place] = Some(*c);
                Column { function, constants }
            };
            let constants = match function.arity {
                1 => &FLOATS[..],
                _ => &FEW,
            };
            let columns: Vec<Column> = constants.iter().map(column).collect();
            tables.extend(columns.chunks(EACH).map(|columns| Table {
                columns: columns.to_vec(),
                inputs: arguments(1),
            }));
        }
    }
    tables
}

/// The arguments of functions of so many, each in a texel: all pairs, and of three all triples of some.
fn arguments(arity: usize) -> Inputs {
    let (size, texels): (UVec2, Vec<Vec4>) = match arity {
        1 => (uvec2(48, 1), FLOATS.map(|x| vec4(x, x, x, 0.0)).to_vec()),
        2 => {
            let pairs = FLOATS.iter().flat_map(|y| FLOATS.map(|x| vec4(x, *y, 0.0, 0.0)));
            (uvec2(48, 48), pairs.collect())
        }
        _ => {
            let pairs = FEW.iter().flat_map(|z| FEW.map(|y| (y, *z)));
            let triples = pairs.flat_map(|(y, z)| FEW.map(|x| vec4(x, y, z, 0.0)));
            (uvec2(64, 64), triples.collect())
        }
    };
    Inputs::new(size).with_image("a", Frame::new(size, texels))
}

impl Table {
    /// The kernel's text.
    fn text(&self) -> String {
        let values = |columns: &[Column]| {
            let blocks = columns
                .iter()
                .map(Column::block)
                .chain(std::iter::repeat("0.0".to_owned()));
            format!(
                "vec4(\n        {},\n    )",
                blocks.take(4).collect::<Vec<_>>().join(",\n        ")
            )
        };
        let targets: Vec<String> = self.columns.chunks(4).map(values).collect();
        let types = vec!["Vec4"; targets.len()].join(", ");
        let (result, value) = match targets.as_slice() {
            [one] => ("Vec4".to_owned(), one.clone()),
            _ => (format!("({types})"), format!("({})", targets.join(", "))),
        };
        format!(
            "use straightline_kernels::prelude::*;\n\npub fn k(a: &Frame<Vec4>, pixel: IVec2) -> {result} {{\n    \
             let (x, y, z) = (a.load(pixel).x, a.load(pixel).y, a.load(pixel).z);\n    {value}\n}}\n"
        )
    }

    fn compiled(&self) -> Result<Compiled, String> {
        let text = self.text();
        let compiled = Kernel::from_text("edges.rs", &text, "k").compile(&Settings::default());
        compiled.map_err(|errors| format!("{text}\n{errors}"))
    }

    /// Values that are compared on each road.
    pub fn values(&self) -> usize {
        self.columns.len() * self.texels().len()
    }

    /// Compiles and emits the kernel, and has its texts compiled.
    ///
    /// # Errors
    ///
    /// The generator refuses the kernel, or a compiler a text.
    pub fn make(&self) -> Result<Made<'_>, String> {
        let compiled = self.compiled()?;
        let targets = [Target::Wgsl, Target::Glsl450, Target::Spirv, Target::Hlsl];
        let options = EmitOptions::new().stage(Stage::Compute).format(Format::Rgba32Float);
        let emitted = compiled.emit(&options.targets(targets)).map_err(|e| e.to_string())?;
        let shaders = LANGUAGES.iter().map(|target| Shader::new(&emitted, *target));
        let shaders = shaders.collect::<Result<_, _>>()?;
        Ok(Made {
            compiled,
            emitted,
            shaders,
            inputs: &self.inputs,
        })
    }

    fn texels(&self) -> &[Vec4] {
        self.inputs.images[0].1[0].texels()
    }

    /// Differences between pictures of the targets and rustc's values.
    pub fn mismatches(&self, road: &str, pictures: &[Frame<Vec4>]) -> Vec<Mismatch> {
        self.compared(road, pictures, compare::on_driver)
    }

    /// Differences between the interpreter's and rustc's values, bit by bit.
    ///
    /// # Errors
    ///
    /// The interpreter cannot run it.
    pub fn mismatches_of_interpreter(&self, made: &Made<'_>) -> Result<Vec<Mismatch>, String> {
        let found = interpret_kernel::<f32>(&made.compiled, made.inputs, false).map_err(|e| e.to_string())?;
        let pictures: Vec<Frame<Vec4>> = found.targets.iter().map(|target| target.frame()).collect();
        Ok(self.compared(INTERPRETER, &pictures, compare::bit_by_bit))
    }

    fn compared(
        &self,
        road: &str,
        pictures: &[Frame<Vec4>],
        compare: impl Fn(&Function, [f32; 3], f32) -> Option<compare::Verdict>,
    ) -> Vec<Mismatch> {
        let mut mismatches = Vec::new();
        for (k, column) in self.columns.iter().enumerate() {
            let picture = &pictures[k / 4];
            for (texel, found) in self.texels().iter().zip(picture.texels()) {
                let (arguments, found) = (column.arguments(*texel), found[k % 4]);
                if let Some(verdict) = compare(column.function, arguments, found) {
                    let [x, y, z] = arguments;
                    mismatches.push(Mismatch {
                        text: column.function.text,
                        function: column.name(),
                        road: road.to_owned(),
                        verdict,
                        constants: column.constants.iter().flatten().copied().collect(),
                        arguments: arguments[..column.function.arity].to_vec(),
                        expected: (column.function.native)(x, y, z),
                        found,
                    });
                }
            }
        }
        mismatches
    }
}
