//! Parameters and results of kernels. Most kernels have a frame, a buffer, three numbers and their pixel, and return a
//! colour; a share of them has further shapes.

use super::orders::Order;
use super::types::{Structure, Ty};
use super::{Feature, Lane, Maker};

/// A parameter: its name and its type.
pub type Parameter = (&'static str, &'static str);

/// Parameters and result of a kernel.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Parameters of functions that take the inputs, except the pixel.
    pub inputs: Vec<Parameter>,
    /// Width and height of the workgroup whose kernel it is.
    pub group: Option<[usize; 2]>,
    /// Type of the value for each pixel.
    pub result: Ty,
}

/// Parameters of every kernel.
const PLAIN: &[Parameter] = &[
    ("a", "&Frame<Vec4>"),
    ("b", "&Buffer<f32>"),
    ("p", "i32"),
    ("q", "u32"),
    ("r", "f32"),
];

/// Additional inputs of a kernel; samplers come with the textures that they read. The native program knows each by its name.
const READ: &[Parameter] = &[
    ("bu", "&Buffer<u32>"),
    ("bi", "&Buffer<i32>"),
    ("bv", "&Buffer<Vec4>"),
    ("bw", "&Buffer<IVec2>"),
    ("bs", "&Buffer<Rec>"),
    ("fu", "&Frame<u32>"),
    ("fi", "&Frame<IVec2>"),
    ("ff", "&Frame<f32>"),
    ("fv", "&Frame<Vec3>"),
    ("fw", "&Frame<UVec4>"),
    ("fl", "&FrameLayers<Vec2>"),
    ("tm", "&Texture<Vec4>"),
    ("ti", "&Texture<IVec4>"),
    ("ta", "&TextureArray<Vec4>"),
    ("tv", "&Texture3D<Vec4>"),
    ("tc", "&TextureCube<Vec4>"),
    ("ts", "&Multisampled<Vec4>"),
    ("td", "&DepthTexture"),
    ("tda", "&DepthTextureArray"),
    ("tdc", "&DepthCube"),
    ("un", "Vec3"),
    ("um", "Mat3"),
    ("ua", "&[Vec2; 3]"),
    ("ui", "[i32; 4]"),
    ("up", "&[Part; 2]"),
    ("scene", "&Scene"),
    ("resolution", "UVec2"),
];

/// Memory that a kernel may write.
const WRITTEN: &[Parameter] = &[
    ("wf", "&StorageBuffer<f32>"),
    ("wv", "&StorageBuffer<Vec4>"),
    ("wi", "&StorageBuffer<IVec2>"),
    ("wt", "&StorageTexture<Vec4>"),
    ("xu", "&AtomicBuffer<u32>"),
    ("xi", "&AtomicBuffer<i32>"),
];

/// Sizes of workgroups, in a frame of 4 by 2 pixels.
const GROUPS: &[[usize; 2]] = &[[2, 2], [4, 2], [4, 1], [3, 2], [8, 1], [1, 4], [2, 1]];

impl Shape {
    /// The shape that most kernels have.
    pub fn plain() -> Shape {
        Shape {
            inputs: PLAIN.to_vec(),
            group: None,
            result: Ty::Vec(Lane::F, 4),
        }
    }

    /// Returns whether the kernel has more parameters than every kernel has.
    pub fn is_wide(&self) -> bool {
        self.inputs.len() > PLAIN.len()
    }

    /// Returns whether the kernel has a parameter of a name.
    pub fn takes(&self, name: &str) -> bool {
        self.inputs.iter().any(|(taken, _)| *taken == name)
    }

    /// The inputs as a function states them.
    pub fn stated(&self) -> Vec<String> {
        self.inputs.iter().map(|(name, ty)| format!("{name}: {ty}")).collect()
    }

    /// The inputs as a call gives them.
    pub fn named(&self) -> Vec<String> {
        self.inputs.iter().map(|(name, _)| (*name).to_owned()).collect()
    }
}

impl Maker {
    /// Decides which shape the kernel has, and makes the types of it.
    pub(super) fn shape(&mut self) {
        let further = !self.on(Feature::Plain) || self.random.once_in(3);
        let any = [Feature::Inputs, Feature::Outputs, Feature::Writes, Feature::Workgroups];
        let any: Vec<Feature> = any.into_iter().filter(|f| self.on(*f)).collect();
        if !further || any.is_empty() {
            return;
        }
        let first = self.random.pick(&any);
        let wants = |m: &mut Maker, feature: Feature| first == feature || m.chance(feature, 4);
        if wants(self, Feature::Inputs) {
            self.further_inputs();
        }
        let writes = wants(self, Feature::Writes);
        if writes {
            let count = 1 + self.random.below(3);
            self.taken(WRITTEN, count);
        }
        if wants(self, Feature::Workgroups) {
            self.shape.group = Some(self.random.pick(GROUPS));
        }
        if wants(self, Feature::Outputs) {
            self.shape.result = self.result_type();
        } else if writes && self.random.once_in(3) {
            self.shape.result = Ty::Tuple(Vec::new());
        }
    }

    /// Some further parameters of a list, in its order.
    fn taken(&mut self, of: &[Parameter], count: usize) {
        let mut picked: Vec<usize> = (0..count).map(|_| self.random.below(of.len())).collect();
        picked.sort_unstable();
        picked.dedup();
        self.shape.inputs.extend(picked.into_iter().map(|k| of[k]));
    }

    fn further_inputs(&mut self) {
        let count = 1 + self.random.below(4);
        self.taken(READ, count);
        let samples = |shape: &Shape, names: &[&str]| names.iter().any(|name| shape.takes(name));
        if samples(&self.shape, &["tm", "ta", "tv", "tc"]) {
            self.shape.inputs.push(("s", "&Sampler"));
        }
        if samples(&self.shape, &["td", "tda", "tdc"]) {
            self.shape.inputs.push(("sc", "&ComparisonSampler"));
        }
        let records = self.shape.takes("bs");
        if records || self.shape.takes("up") {
            let part = self.stated_structure("Part", &[("scale", Ty::F32), ("powers", Ty::array(Ty::F32, 3))]);
            if records {
                let (place, tints) = (Ty::Vec(Lane::F, 3), Ty::array(Ty::Vec(Lane::F, 3), 2));
                self.stated_structure(
                    "Rec",
                    &[
                        ("place", place),
                        ("kind", Ty::U32),
                        ("part", part),
                        ("turn", Ty::Mat(2)),
                        ("tints", tints),
                    ],
                );
            }
        }
        if self.shape.takes("scene") {
            self.open("pub struct Scene<'a> {");
            self.line("pub shade: &'a Frame<f32>,");
            self.line("pub table: &'a Buffer<i32>,");
            self.line("pub tint: Vec3,");
            self.line("pub steps: [u32; 3],");
            self.close("}");
        }
    }

    /// A structure whose fields are as stated.
    fn stated_structure(&mut self, name: &str, fields: &[(&str, Ty)]) -> Ty {
        self.line("#[derive(Clone, Copy)]");
        self.open(format!("pub struct {name} {{"));
        for (field, ty) in fields {
            let text = format!("pub {field}: {},", self.ty(ty));
            self.line(text);
        }
        self.close("}");
        self.structures.push(Structure {
            name: name.to_owned(),
            fields: fields
                .iter()
                .map(|(field, ty)| ((*field).to_owned(), ty.clone()))
                .collect(),
            tuple: false,
            copy: true,
            operators: false,
            order: Order::None,
        });
        Ty::Struct(self.structures.len() - 1)
    }

    /// A number or vector, or several as a tuple or a structure.
    fn result_type(&mut self) -> Ty {
        // WebGPU promises four storage textures, of which a picture that is written is one.
        let most = if self.shape.takes("wt") { 3 } else { 4 };
        let count = self.random.between(2, most) as usize;
        match self.random.below(4) {
            0 => self.plain_type(),
            1 => Ty::Tuple((0..count).map(|_| self.plain_type()).collect()),
            _ => {
                let names = ["albedo", "normal", "motion", "depth"];
                let fields: Vec<(&str, Ty)> = names[..count].iter().map(|name| (*name, self.plain_type())).collect();
                self.stated_structure("Out", &fields)
            }
        }
    }
}
