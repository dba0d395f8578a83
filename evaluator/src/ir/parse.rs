//! Parsing of a graph from its text.
//!
//! File tests: `evaluator/tests/filetests/parse`.

use super::{
    Access, AtomicOp, Axis, BinaryOp, Buffer, Counter, Element, Event, Graph, Invocation, Memory, Node, NodeId, Op,
    Origin, OutputTarget, Override, QuadDirection, Region, RegionId, Sampler, Scalar, SharedArray, Structure, Texture,
    TextureKind, Type, UnaryOp, Uniform, UniformPart, Varying,
};

/// An error in the text of a graph.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct ParseError {
    /// Line, from 1.
    pub line: usize,
    /// Description of the error.
    pub problem: String,
}

/// Parses the output of [`super::print`]. The graph is built as written, without simplification. [`super::verify`] checks
/// the rules.
///
/// # Errors
///
/// The first line that cannot be parsed, and the reason.
pub fn parse(text: &str) -> Result<Graph, ParseError> {
    let mut reader = GraphParser::default();
    reader.graph.regions.push(empty_region(None));
    reader.open.push(Graph::BODY);
    for (k, line) in text.lines().enumerate() {
        reader
            .line(line.trim())
            .map_err(|problem| ParseError { line: k + 1, problem })?;
    }
    let last = text.lines().count();
    if !reader.has_output {
        return Err(ParseError {
            line: last,
            problem: "there is no `output %N` at the end".to_owned(),
        });
    }
    if reader.open.len() > 1 {
        return Err(ParseError {
            line: last,
            problem: "a region is not closed".to_owned(),
        });
    }
    reader.event(Event::Close(Graph::BODY));
    if reader.graph.targets.is_empty() && !reader.gives_nothing {
        reader.graph.targets.push(OutputTarget::default_color());
    }
    Ok(reader.graph)
}

#[derive(Default)]
struct GraphParser {
    graph: Graph,
    has_output: bool,
    gives_nothing: bool,
    open: Vec<RegionId>,
}

type Parsed<T = ()> = Result<T, String>;

impl GraphParser {
    fn event(&mut self, event: Event) {
        self.graph.events.push((self.graph.nodes.len() as u32, event));
    }

    fn line(&mut self, line: &str) -> Parsed {
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        match word {
            "" => Ok(()),
            _ if line.starts_with("//") => Ok(()),
            "file" => {
                self.graph.files.push(rest.to_owned());
                Ok(())
            }
            "tally" => {
                self.graph.tallies.push(rest.to_owned());
                Ok(())
            }
            "texture" => self.texture(rest),
            "buffer" => self.buffer(rest),
            "image" => {
                let (name, rest) = split_name(rest)?;
                let (ty, tile) = match rest.split_whitespace().collect::<Vec<_>>()[..] {
                    [ty] => (ty, None),
                    [ty, "tile", width, height] => (ty, Some([parse_number(width)?, parse_number(height)?])),
                    _ => return Err("an image is `image NAME: TYPE`, and `tile WIDTH HEIGHT`".to_owned()),
                };
                let ty = parse_type(ty)?;
                self.graph.images.push(OutputTarget { name, ty, tile });
                Ok(())
            }
            "shared" => self.shared(rest),
            "sampler" => self.sampler(rest),
            "uniform" => self.uniform(rest),
            "override" => self.override_option(rest),
            "varying" => {
                let (name, kind) = split_name(rest)?;
                let ty = parse_type(kind)?;
                self.graph.varyings.push(Varying { name, ty });
                Ok(())
            }
            "target" if rest == "none" => {
                self.gives_nothing = true;
                Ok(())
            }
            "target" => {
                let (name, kind) = split_name(rest)?;
                let ty = parse_type(kind)?;
                self.graph.targets.push(OutputTarget { name, ty, tile: None });
                Ok(())
            }
            "invocation" => self.invocation(rest),
            "region" => match rest.strip_suffix('}') {
                Some(empty) => self.open(empty).and_then(|()| self.close()),
                None => self.open(rest),
            },
            "}" => self.close(),
            "output" => {
                let outputs = rest.split_whitespace().map(|word| self.node_id(word));
                self.graph.regions[0].results = outputs.collect::<Parsed<_>>()?;
                self.has_output = true;
                Ok(())
            }
            _ if word.starts_with('%') => self.node(line),
            _ => Err(format!("`{word}` begins no line")),
        }
    }

    fn texture(&mut self, text: &str) -> Parsed {
        let (name, rest) = split_name(text)?;
        let words: Vec<&str> = rest.split_whitespace().collect();
        let (kind, components, size, kind_of_number) = match words[..] {
            [kind, components, size] => (kind, components, size, Scalar::F32),
            [kind, components, size, number] => (kind, components, size, parse_scalar(number)?),
            _ => return Err("a texture is `texture NAME: KIND COMPONENTS frame|own`, and `i32` or `u32`".to_owned()),
        };
        let found = TextureKind::ALL.into_iter().find(|(_, word)| *word == kind);
        let (kind, _) = found.ok_or_else(|| format!("`{kind}` is no kind of texture"))?;
        self.graph.textures.push(Texture {
            name,
            kind,
            scalar: kind_of_number,
            components: parse_number(components)?,
            declared: parse_number(components)?,
            framed: size == "frame",
        });
        Ok(())
    }

    fn buffer(&mut self, text: &str) -> Parsed {
        let (name, rest) = split_name(text)?;
        let (rest, access) = match rest.rsplit_once(' ') {
            Some((rest, "write")) => (rest, Access::Write),
            Some((rest, "atomic")) => (rest, Access::Atomic),
            _ => (rest, Access::Read),
        };
        let element = match rest.strip_prefix("struct ") {
            None => Element::Value(parse_type(rest)?),
            Some(rest) => {
                let body = rest.strip_suffix(" }").and_then(|rest| rest.split_once(" { "));
                let (of, fields) = body.ok_or("a structure is `struct NAME { FIELD: TYPE; ... }`")?;
                let fields = fields.split("; ").map(|field| {
                    let (name, kind) = split_name(field)?;
                    Ok((name, parse_type(kind)?))
                });
                Element::Struct(Structure::new(of.to_owned(), fields.collect::<Parsed<_>>()?))
            }
        };
        self.graph.buffers.push(Buffer { name, element, access });
        Ok(())
    }

    fn shared(&mut self, text: &str) -> Parsed {
        let (name, rest) = split_name(text)?;
        let (element, len, how) = match rest.split_whitespace().collect::<Vec<_>>()[..] {
            [element, len] => (element, len, ""),
            [element, len, how @ ("atomic" | "filled")] => (element, len, how),
            _ => return Err("what is shared is `shared NAME: TYPE LENGTH`, and `atomic` or `filled`".to_owned()),
        };
        let (element, len) = (parse_type(element)?, parse_number(len)?);
        self.graph.shared.push(SharedArray {
            name,
            element,
            len,
            atomic: how == "atomic",
            filled: how == "filled",
        });
        Ok(())
    }

    fn sampler(&mut self, text: &str) -> Parsed {
        let (name, rest) = split_name(text)?;
        let (comparison, filters) = match rest {
            "comparison" => (true, false),
            "filtering" => (false, true),
            "nearest" => (false, false),
            _ => return Err("a sampler is filtering, comparison or nearest".to_owned()),
        };
        self.graph.samplers.push(Sampler {
            name,
            comparison,
            filters,
        });
        Ok(())
    }

    fn uniform(&mut self, text: &str) -> Parsed {
        let (name, rest) = split_name(text)?;
        let (kind, default) = match rest.split_once(" = ") {
            Some((kind, default)) => (kind, Some(parse_number(default)?)),
            None => (rest, None),
        };
        let (kind, part) = match kind.split_once(" of ") {
            Some((kind, part)) => (kind, Some(self::parse_part(part)?)),
            None => (kind, None),
        };
        let ty = parse_type(kind)?;
        self.graph.uniforms.push(Uniform {
            name,
            ty,
            default,
            part,
        });
        Ok(())
    }

    fn override_option(&mut self, text: &str) -> Parsed {
        let (name, rest) = split_name(text)?;
        let form = "an override is `override NAME: TYPE ID = DEFAULT`, with `from LOW to HIGH` for a range";
        let (head, values) = rest.split_once(" = ").ok_or(form)?;
        let (ty, id) = head.split_once(' ').ok_or(form)?;
        let words: Vec<&str> = values.split_whitespace().collect();
        let (default, range) = match words[..] {
            [default] => (default, None),
            [default, "from", low, "to", high] => (default, Some([parse_number(low)?, parse_number(high)?])),
            _ => return Err(form.to_owned()),
        };
        self.graph.overrides.push(Override {
            name,
            id: parse_number(id)?,
            ty: parse_type(ty)?,
            default: parse_number(default)?,
            range,
        });
        Ok(())
    }

    fn invocation(&mut self, text: &str) -> Parsed {
        let words: Vec<&str> = text.split_whitespace().collect();
        self.graph.invocation = match words[..] {
            ["may-be-outside"] => Invocation::MayBeOutside,
            ["lane"] => Invocation::Lane,
            ["block", width, height] => Invocation::Block([parse_number(width)?, parse_number(height)?]),
            ["group", width, height] => Invocation::Group([parse_number(width)?, parse_number(height)?]),
            _ => {
                return Err(
                    "an invocation is `may-be-outside`, `lane`, `block WIDTH HEIGHT` or `group WIDTH HEIGHT`"
                        .to_owned(),
                );
            }
        };
        Ok(())
    }

    fn open(&mut self, text: &str) -> Parsed {
        let id: u32 = parse_number(text.strip_suffix(" {").ok_or("a region is `region N {`")?)?;
        if id as usize != self.graph.regions.len() {
            return Err(format!(
                "regions are numbered in order: this is region {}",
                self.graph.regions.len()
            ));
        }
        let region = empty_region(self.open.last().copied());
        self.graph.regions.push(region);
        self.open.push(RegionId(id));
        self.event(Event::Open(RegionId(id)));
        Ok(())
    }

    fn close(&mut self) -> Parsed {
        match self.open.pop() {
            Some(region) if region != Graph::BODY => {
                self.event(Event::Close(region));
                Ok(())
            }
            _ => Err("there is no region to close".to_owned()),
        }
    }

    fn node_id(&self, text: &str) -> Parsed<NodeId> {
        let id = text
            .strip_prefix('%')
            .ok_or_else(|| format!("`{text}` is not a node"))?;
        let id: u32 = parse_number(id)?;
        if id as usize >= self.graph.nodes.len() {
            return Err(format!("%{id} is not made yet"));
        }
        Ok(NodeId(id))
    }

    fn node(&mut self, line: &str) -> Parsed {
        let (line, origin) = match line.split_once("    // ") {
            Some((line, origin)) => (line, Some(read_origin(origin)?)),
            None => (line, None),
        };
        let (head, body) = line.split_once(" = ").ok_or("a node is `%N: TYPE = OPERATION`")?;
        let (id, kind) = head.split_once(": ").ok_or("a node is `%N: TYPE = OPERATION`")?;
        if id != format!("%{}", self.graph.nodes.len()) {
            return Err(format!(
                "nodes are numbered in order: this is %{}",
                self.graph.nodes.len()
            ));
        }
        let ty = parse_type(kind)?;
        let mut parts = body.split(" yields ");
        let mut words = parts.next().unwrap_or_default().split_whitespace().peekable();
        let name = words.next().ok_or("an operation is missing")?;
        let mut plain = Vec::new();
        while let Some(word) = words.next_if(|w| !w.starts_with('%')) {
            plain.push(word);
        }
        let args = words.map(|w| self.node_id(w)).collect::<Parsed<Vec<NodeId>>>()?;
        let op = self.op(name, &plain, ty)?;
        let here = NodeId(self.graph.nodes.len() as u32);
        for part in parts {
            let (region, results) = part.split_once(':').ok_or("results are `yields REGION: %A %B`")?;
            let region: u32 = parse_number(region)?;
            let (results, stop) = match results.split_once(" stops ") {
                Some((results, stop)) => (results, Some(self.node_id(stop.trim())?)),
                None => (results, None),
            };
            let results = results
                .split_whitespace()
                .map(|w| self.node_id(w))
                .collect::<Parsed<_>>()?;
            let slot = self.graph.regions.get_mut(region as usize).ok_or("no such region")?;
            (slot.results, slot.stop) = (results, stop);
        }
        if let Op::Param(region, _) = op {
            let slot = self.graph.regions.get_mut(region.0 as usize).ok_or("no such region")?;
            slot.params.push(here);
        }
        self.graph.nodes.push(Node { op, args, ty });
        self.graph.origins.push(origin);
        let home = self.open.last().copied().unwrap_or(Graph::BODY);
        self.graph.homes.push(home);
        let has = |region: &RegionId| {
            self.graph
                .regions
                .get(region.0 as usize)
                .is_some_and(|r| !r.effects.is_empty())
        };
        if self.graph.node(here).op.is_effect() || self.graph.regions_of(here).iter().any(has) {
            self.graph.regions[home.0 as usize].effects.push(here);
        }
        Ok(())
    }

    fn op(&self, name: &str, words: &[&str], ty: Type) -> Parsed<Op> {
        let word = |k: usize| words.get(k).copied().ok_or_else(|| format!("`{name}` lacks a word"));
        let (g, missing) = (&self.graph, |what: &str| format!("there is no such {what}"));
        let texture = || -> Parsed<u32> {
            let found = find_position(g.textures.iter().map(|t| &t.name), word(0)?);
            found.ok_or_else(|| missing("texture"))
        };
        let sampler = || -> Parsed<u32> {
            let found = find_position(g.samplers.iter().map(|s| &s.name), word(1)?);
            found.ok_or_else(|| missing("sampler"))
        };
        let buffer_at = |k: usize| -> Parsed<u32> {
            let name = word(k)?.split('.').next().unwrap_or_default();
            let found = find_position(g.buffers.iter().map(|b| &b.name), name);
            found.ok_or_else(|| missing("buffer"))
        };
        let buffer = || buffer_at(0);
        let shared = |k: usize| -> Parsed<u32> {
            let found = find_position(g.shared.iter().map(|s| &s.name), word(k)?);
            found.ok_or_else(|| missing("memory"))
        };
        let memory = |k: usize| -> Parsed<Memory> {
            let image = find_position(g.images.iter().map(|image| &image.name), word(k)?);
            match (image, buffer_at(k)) {
                (Some(image), _) => Ok(Memory::Image(image)),
                (None, Ok(buffer)) => Ok(Memory::Buffer(buffer)),
                (None, Err(_)) => shared(k).map(Memory::Shared),
            }
        };
        let site = match words.iter().find_map(|w| w.strip_prefix("site=")) {
            Some(site) => parse_number(site)?,
            None => 0,
        };
        let region = |k: usize| -> Parsed<RegionId> {
            let text = words.iter().filter_map(|w| w.strip_prefix("region=")).nth(k);
            Ok(RegionId(parse_number(text.ok_or_else(|| missing("region"))?)?))
        };
        Ok(match name {
            "const" => {
                let mut bits = [0; 4];
                if words.len() != ty.component_count() as usize {
                    return Err(format!("a constant {ty} has {} lanes", ty.component_count()));
                }
                for (slot, word) in bits.iter_mut().zip(words) {
                    *slot = parse_component(ty, word)?;
                }
                Op::Const(bits)
            }
            "pixel" => Op::Pixel,
            "framesize" => Op::FrameSize,
            "lane" => Op::Lane,
            "thread" => Op::Thread,
            "grouporigin" => Op::GroupOrigin,
            "inside" => Op::Inside,
            "quad_swap" => {
                let found = QuadDirection::ALL
                    .into_iter()
                    .find(|d| format!("{d:?}") == words.concat());
                Op::QuadSwap(found.ok_or_else(|| missing("direction"))?)
            }
            "derivative" => {
                let found = [Axis::X, Axis::Y]
                    .into_iter()
                    .find(|a| format!("{a:?}") == words.concat());
                Op::Derivative(found.ok_or_else(|| missing("axis"))?)
            }
            "varying" => Op::Varying(
                find_position(g.varyings.iter().map(|v| &v.name), word(0)?).ok_or_else(|| missing("varying"))?,
            ),
            "gathercompare" => Op::GatherCompare {
                texture: texture()?,
                sampler: sampler()?,
                site,
            },
            "uniform" => Op::Uniform(
                find_position(g.uniforms.iter().map(|u| &u.name), word(0)?).ok_or_else(|| missing("uniform"))?,
            ),
            "override" => Op::Override(
                find_position(g.overrides.iter().map(|o| &o.name), word(0)?).ok_or_else(|| missing("override"))?,
            ),
            "unary" => Op::Unary(parse_unary(word(0)?).ok_or_else(|| missing("operation"))?),
            "binary" => Op::Binary(parse_binary(word(0)?).ok_or_else(|| missing("operation"))?),
            "undef" => Op::Undef,
            "dot" => Op::Dot,
            "cross" => Op::Cross,
            "clamp" => Op::Clamp,
            "select" => Op::Select,
            "splat" => Op::Splat,
            "compose" => Op::Compose,
            "extract" => Op::Extract(parse_number(word(0)?)?),
            "convert" => Op::Convert,
            "bitcast" => Op::Bitcast,
            "texturesize" => Op::TextureSize(texture()?),
            "texturelevels" => Op::TextureLevels(texture()?),
            "texturelayers" => Op::TextureLayers(texture()?),
            "load" => Op::Load {
                texture: texture()?,
                site,
            },
            "sample" => Op::Sample {
                texture: texture()?,
                sampler: sampler()?,
                site,
            },
            "gather" => Op::Gather {
                texture: texture()?,
                sampler: sampler()?,
                component: parse_number(word(2)?)?,
                site,
            },
            "compare" => Op::Compare {
                texture: texture()?,
                sampler: sampler()?,
                site,
            },
            "bufferlen" => Op::BufferLen(buffer()?),
            "bufferload" => Op::BufferLoad {
                buffer: buffer()?,
                field: match (word(0)?.split_once('.'), &g.buffers[buffer()? as usize].element) {
                    (Some((_, field)), Element::Struct(of)) => {
                        let found = find_position(of.fields.iter().map(|f| &f.name), field);
                        found.ok_or_else(|| missing("field"))?
                    }
                    _ => 0,
                },
                site,
            },
            "atomic" => {
                let spelled = word(0)?;
                let found = AtomicOp::ALL.into_iter().find(|op| format!("{op:?}") == spelled);
                Op::Atomic {
                    memory: memory(1)?,
                    op: found.ok_or_else(|| missing("operation"))?,
                }
            }
            "store" => Op::Store(memory(0)?),
            "sharedload" => Op::SharedLoad(shared(0)?),
            "barrier" => Op::Barrier {
                buffers: words.first() == Some(&"buffers"),
            },
            "tally" => Op::Tally(find_position(g.tallies.iter(), word(0)?).ok_or_else(|| missing("tally"))?),
            "exact" => Op::Exact,
            "half" => Op::Half,
            "makearray" => Op::MakeArray,
            "arrayget" => Op::ArrayGet,
            "arrayset" => Op::ArraySet,
            "loop" => Op::Loop(region(0)?),
            "if" => Op::If(region(0)?, region(1)?),
            "result" => Op::Result(parse_number(word(0)?)?),
            "param" => Op::Param(region(0)?, parse_number(word(0)?)?),
            _ => return Err(format!("`{name}` is no operation")),
        })
    }
}

fn empty_region(parent: Option<RegionId>) -> Region {
    Region {
        parent,
        params: Vec::new(),
        results: Vec::new(),
        stop: None,
        effects: Vec::new(),
    }
}

fn find_position<'a>(mut names: impl Iterator<Item = &'a String>, name: &str) -> Option<u32> {
    names.position(|known| known == name).map(|k| k as u32)
}

/// Parses the whole that a uniform is a part of: `grade column 0 3`.
fn parse_part(text: &str) -> Parsed<UniformPart> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let (of, columns, index, count) = match words[..] {
        [of, "column", index, count] => (of, true, index, count),
        [of, "element", index, count] => (of, false, index, count),
        _ => return Err("a part is `NAME column INDEX COUNT` or `NAME element INDEX COUNT`".to_owned()),
    };
    Ok(UniformPart {
        of: of.to_owned(),
        index: parse_number(index)?,
        count: parse_number(count)?,
        columns,
    })
}

fn split_name(text: &str) -> Parsed<(String, &str)> {
    let (name, rest) = text.split_once(": ").ok_or("expected `NAME: ...`")?;
    Ok((name.to_owned(), rest))
}

fn parse_number<T: std::str::FromStr>(text: &str) -> Parsed<T> {
    text.parse()
        .map_err(|_| format!("`{text}` is not a number that fits here"))
}

fn parse_scalar(text: &str) -> Parsed<Scalar> {
    let all = [Scalar::Bool, Scalar::I32, Scalar::U32, Scalar::F32];
    let found = all.into_iter().find(|s| s.to_string() == text);
    found.ok_or_else(|| format!("`{text}` is no type"))
}

/// Parses `f32`, `vec3<i32>`, `array<vec4<f32>, 9>`, `results`.
fn parse_type(text: &str) -> Parsed<Type> {
    if text == "results" {
        return Ok(Type::Results);
    }
    if let Some(inner) = text.strip_prefix("array<").and_then(|t| t.strip_suffix('>')) {
        let (element, len) = inner.rsplit_once(", ").ok_or("an array is `array<TYPE, LENGTH>`")?;
        let Type::Value {
            scalar,
            components: lanes,
        } = parse_type(element)?
        else {
            return Err("an array holds scalars or vectors".to_owned());
        };
        let len = parse_number(len)?;
        return Ok(Type::Array {
            scalar,
            components: lanes,
            len,
        });
    }
    if let Some(inner) = text.strip_prefix("vec").and_then(|t| t.strip_suffix('>')) {
        let (lanes, kind) = inner.split_once('<').ok_or("a vector is `vecN<TYPE>`")?;
        let lanes: u8 = parse_number(lanes)?;
        if !(2..=4).contains(&lanes) {
            return Err("a vector has 2 to 4 lanes".to_owned());
        }
        return Ok(Type::value(parse_scalar(kind)?, lanes));
    }
    Ok(Type::scalar(parse_scalar(text)?))
}

fn parse_component(ty: Type, text: &str) -> Parsed<u32> {
    if let Some(bits) = text.strip_prefix("bits:") {
        return u32::from_str_radix(bits, 16).map_err(|_| format!("`{text}` is no bits"));
    }
    match ty.scalar_kind() {
        Some(Scalar::F32) => Ok(parse_number::<f32>(text)?.to_bits()),
        Some(Scalar::I32) => Ok(parse_number::<i32>(text)? as u32),
        _ => parse_number(text),
    }
}

fn read_origin(text: &str) -> Parsed<Origin> {
    let mut words = text.split_whitespace();
    let mut name = String::new();
    let mut place = words.next().ok_or("an origin is `NAME @FILE:LINE`")?;
    if !place.starts_with('@') {
        name = place.to_owned();
        place = words.next().ok_or("an origin is `NAME @FILE:LINE`")?;
    }
    let place = place.strip_prefix('@').and_then(|p| p.split_once(':'));
    let (file, line) = place.ok_or("an origin is `NAME @FILE:LINE`")?;
    let counters = words.map(|word| {
        let (name, value) = word.split_once('=').ok_or("a counter is `NAME=VALUE`")?;
        Ok(Counter {
            name: name.into(),
            value: parse_number(value)?,
        })
    });
    Ok(Origin {
        name: name.into(),
        naming: Default::default(),
        file: parse_number(file)?,
        line: parse_number(line)?,
        counters: counters.collect::<Parsed<_>>()?,
    })
}

fn parse_unary(text: &str) -> Option<UnaryOp> {
    UnaryOp::ALL.into_iter().find(|op| format!("{op:?}") == text)
}

fn parse_binary(text: &str) -> Option<BinaryOp> {
    BinaryOp::ALL.into_iter().find(|op| format!("{op:?}") == text)
}
