//! Reads of further inputs.

use super::types::{Lane, Ty};
use super::{Feature, Maker, Want};

/// The parameter, the type that a read gives, and the read: `@c` stands for a coordinate, `@d` for one in a volume, `@u` for a
/// place in a picture, `@v` for one in a volume or a direction, `@f` for a float, `@2` to `@9` for an index below that number,
/// `#3` and `#4` for one that is a compile-time constant.
type Read = (&'static str, &'static str, &'static str);

/// Reads that every device does in the same bits.
const EXACT: &[Read] = &[
    ("bu", "u32", "bu.load(@9)"),
    ("bu", "usize", "bu.len()"),
    ("bi", "i32", "bi.load(@5)"),
    ("bv", "Vec4", "bv.load(@4)"),
    ("bw", "IVec2", "bw.load(@6)"),
    ("bs", "Rec", "bs.load(@4)"),
    ("bs", "Part", "bs.load(@3).part"),
    ("bs", "Vec3", "bs.load(@3).place"),
    ("bs", "u32", "bs.load(@5).kind"),
    ("bs", "f32", "bs.load(@3).part.powers[@3]"),
    ("bs", "f32", "bs.load(@3).part.scale"),
    ("bs", "Mat2", "bs.load(@2).turn"),
    ("bs", "Vec3", "bs.load(@3).tints[@2]"),
    ("bs", "usize", "bs.len()"),
    ("fu", "u32", "fu.load(@c)"),
    ("fi", "IVec2", "fi.load(@c)"),
    ("ff", "f32", "ff.load(@c)"),
    ("fv", "Vec3", "fv.load(@c)"),
    ("fw", "UVec4", "fw.load(@c)"),
    ("fw", "UVec2", "fw.size()"),
    ("fl", "Vec2", "fl.load(@c, #3)"),
    ("tm", "Vec4", "tm.load(@c)"),
    ("tm", "Vec4", "tm.load_level(@c, @5)"),
    ("tm", "UVec2", "tm.size()"),
    ("tm", "UVec2", "tm.size_of_level(@4)"),
    ("tm", "usize", "tm.levels()"),
    ("ti", "IVec4", "ti.load(@c)"),
    ("ti", "UVec2", "ti.size()"),
    ("ta", "Vec4", "ta.load(@c, @5)"),
    ("ta", "usize", "ta.layers()"),
    ("ta", "UVec2", "ta.size()"),
    ("tv", "Vec4", "tv.load(@d)"),
    ("tv", "UVec3", "tv.size()"),
    ("tc", "UVec2", "tc.size()"),
    ("tc", "usize", "tc.levels()"),
    ("ts", "Vec4", "ts.load(@c, #4)"),
    ("ts", "UVec2", "ts.size()"),
    ("td", "UVec2", "td.size()"),
    ("td", "f32", "td.load(@c)"),
    ("tda", "f32", "tda.load(@c, @3)"),
    ("tda", "usize", "tda.layers()"),
    ("tdc", "UVec2", "tdc.size()"),
    ("un", "Vec3", "un"),
    ("un", "f32", "un.y"),
    ("um", "Mat3", "um"),
    ("ua", "Vec2", "ua[@3]"),
    ("ua", "[Vec2; 3]", "(*ua)"),
    ("ui", "i32", "ui[@4]"),
    ("up", "Part", "up[@2]"),
    ("up", "f32", "up[@2].scale"),
    ("up", "f32", "up[@2].powers[@3]"),
    ("scene", "f32", "scene.shade.load(@c)"),
    ("scene", "i32", "scene.table.load(@5)"),
    ("scene", "Vec3", "scene.tint"),
    ("scene", "u32", "scene.steps[@3]"),
    ("resolution", "UVec2", "resolution"),
    ("resolution", "u32", "resolution.y"),
    ("wf", "usize", "wf.len()"),
    ("xu", "usize", "xu.len()"),
];

/// Reads through samplers, whose weights have few bits on a device.
const FILTERED: &[Read] = &[
    ("tm", "Vec4", "tm.sample(s, @u)"),
    ("tm", "Vec4", "tm.sample_level(s, @u, @f)"),
    ("tm", "Vec4", "tm.sample_grad(s, @u, vec2(@f, 0.125), vec2(0.0625, @f))"),
    ("tm", "Vec4", "tm.gather(#4, s, @u)"),
    ("ta", "Vec4", "ta.sample(s, @u, @4)"),
    ("ta", "Vec4", "ta.sample_level(s, @u, @4, @f)"),
    ("tv", "Vec4", "tv.sample(s, @v)"),
    ("tv", "Vec4", "tv.sample_level(s, @v, @f)"),
    ("tc", "Vec4", "tc.sample(s, @v)"),
    ("tc", "Vec4", "tc.sample_level(s, @v, @f)"),
    ("td", "f32", "td.compare(sc, @u, @f)"),
    ("td", "Vec4", "td.gather_compare(sc, @u, @f)"),
    ("tda", "f32", "tda.compare(sc, @u, @3, @f)"),
    ("tdc", "f32", "tdc.compare(sc, @v, @f)"),
];

impl Maker {
    /// Something of the further inputs that is of a type.
    pub(super) fn further(&mut self, ty: &Ty) -> Option<String> {
        let wanted = self.ty(ty);
        let filtered = if self.on(Feature::Coarse) { FILTERED } else { &[] };
        let reads = EXACT.iter().chain(filtered);
        let fit: Vec<&str> = reads
            .filter(|(of, given, _)| *given == wanted && self.shape.takes(of))
            .map(|(.., read)| *read)
            .collect();
        // Operands of an index read no further input.
        if fit.is_empty() || self.reading {
            return None;
        }
        let read = self.random.pick(&fit);
        self.reading = true;
        let text = self.filled(read);
        self.reading = false;
        Some(text)
    }

    /// A variable for what any of the further inputs has.
    pub(super) fn read_further(&mut self) {
        let reads = EXACT
            .iter()
            .chain(if self.on(Feature::Coarse) { FILTERED } else { &[] });
        let taken: Vec<&Read> = reads.filter(|(of, ..)| self.shape.takes(of)).collect();
        if taken.is_empty() || self.reading {
            return self.assign();
        }
        let (_, given, read) = *self.random.pick(&taken);
        let Some(ty) = self.type_named(given) else {
            return self.assign();
        };
        self.reading = true;
        let value = self.filled(read);
        self.reading = false;
        let name = self.name();
        self.line(format!("let {name}: {given} = {value};"));
        self.bind(&name, &ty, false);
    }

    /// The type that Rust writes so.
    fn type_named(&self, text: &str) -> Option<Ty> {
        let lanes = |name: &str| text.strip_prefix(name).and_then(|n| n.parse().ok());
        Some(match text {
            "f32" => Ty::F32,
            "i32" => Ty::I32,
            "u32" => Ty::U32,
            "usize" => Ty::Usize,
            "Mat2" => Ty::Mat(2),
            "Mat3" => Ty::Mat(3),
            "[Vec2; 3]" => Ty::array(Ty::Vec(Lane::F, 2), 3),
            _ => match (lanes("Vec"), lanes("IVec"), lanes("UVec")) {
                (Some(n), ..) => Ty::Vec(Lane::F, n),
                (_, Some(n), _) => Ty::Vec(Lane::I, n),
                (.., Some(n)) => Ty::Vec(Lane::U, n),
                _ => Ty::Struct(self.structures.iter().position(|s| s.name == text)?),
            },
        })
    }

    /// A read with something for all that is left open.
    fn filled(&mut self, read: &str) -> String {
        let mut text = String::new();
        let mut rest = read;
        while let Some(at) = rest.find(['@', '#']) {
            text += &rest[..at];
            let known = rest[at..].starts_with('#');
            let what = rest[at + 1..].chars().next().expect("a placeholder has a letter");
            text += &match what {
                'c' => self.coordinate(),
                'd' => format!("({}).extend({})", self.coordinate(), self.random.between(-1, 2)),
                'u' => self.place(2),
                'v' => self.place(3),
                'f' => self.near_zero(),
                n => {
                    let len = n.to_digit(10).expect("a length") as usize;
                    // A counter of a loop that stays one is no compile-time constant.
                    if known {
                        self.random.below(len).to_string()
                    } else {
                        self.index(len, false, 1)
                    }
                }
            };
            rest = &rest[at + 2..];
        }
        text + rest
    }

    fn coordinate(&mut self) -> String {
        let (x, y) = (self.random.between(-2, 2), self.random.between(-1, 1));
        match self.random.below(4) {
            0 => "pixel".to_owned(),
            1 => {
                let want = self.wish(1);
                format!("({} & 3)", self.receiver(&Ty::Vec(Lane::I, 2), want))
            }
            2 => format!("pixel / 2 + ivec2({x}, {y})"),
            _ => format!("pixel + ivec2({x}, {y})"),
        }
    }

    /// A place, mostly in 0..1, that no NaN reaches.
    fn place(&mut self, lanes: usize) -> String {
        let all: Vec<String> = (0..lanes).map(|_| self.near_zero()).collect();
        format!("vec{lanes}({})", all.join(", "))
    }

    fn near_zero(&mut self) -> String {
        let want = Want {
            depth: 1,
            known: false,
            inferred: false,
        };
        match self.random.below(3) {
            0 => format!("{:?}", self.random.between(1, 15) as f32 / 16.0),
            1 => "(pixel.x as f32 * 0.25 + 0.0625)".to_owned(),
            // A maximum gives the number of a NaN and a number.
            _ => format!("({}.max(-8.0).min(8.0) * 0.125)", self.float_receiver(want)),
        }
    }
}
