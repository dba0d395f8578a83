/// Inputs of a kernel call.
pub struct World {
    a: Frame<Vec4>,
    b: Buffer<f32>,
    c: resources::Resources,
}

/// Contents of a texel of a target, or an element of a buffer.
type Texel = [f64; 4];

/// Numbers that a kernel gives.
pub trait Given {
    /// Of each target its texel: components that a value lacks are 0, and the fourth is 1.
    fn texels(&self, out: &mut Vec<Texel>);
}

/// An element of a buffer.
pub trait Held: Given {
    fn lanes(&self) -> Texel;
}

macro_rules! given {
    ($($number:ty),*; $($vector:ty),*) => {
        $(impl Given for $number {
            fn texels(&self, out: &mut Vec<Texel>) {
                out.push([f64::from(*self), 0.0, 0.0, 1.0]);
            }
        }
        impl Held for $number {
            fn lanes(&self) -> Texel {
                [f64::from(*self), 0.0, 0.0, 0.0]
            }
        })*
        $(impl Given for $vector {
            fn texels(&self, out: &mut Vec<Texel>) {
                let mut texel = [0.0, 0.0, 0.0, 1.0];
                texel.iter_mut().zip(self.to_array()).for_each(|(lane, x)| *lane = f64::from(x));
                out.push(texel);
            }
        }
        impl Held for $vector {
            fn lanes(&self) -> Texel {
                let mut lanes = [0.0; 4];
                lanes.iter_mut().zip(self.to_array()).for_each(|(lane, x)| *lane = f64::from(x));
                lanes
            }
        })*
    };
}

given!(f32, i32, u32; Vec2, Vec3, Vec4, IVec2, IVec3, IVec4, UVec2, UVec3, UVec4);

macro_rules! tuples {
    ($($($part:ident)*;)*) => {
        $(impl<$($part: Given),*> Given for ($($part,)*) {
            #[allow(non_snake_case)]
            fn texels(&self, out: &mut Vec<Texel>) {
                let ($($part,)*) = self;
                $($part.texels(out);)*
            }
        })*
    };
}

tuples! { ; A B; A B C; A B C D; }

/// Result of a kernel of workgroups.
pub trait Threads {
    /// Of each thread, row by row.
    fn threads(&self) -> Vec<Vec<Texel>>;
}

impl Threads for () {
    fn threads(&self) -> Vec<Vec<Texel>> {
        Vec::new()
    }
}

impl<T: Given> Threads for PerThread<T> {
    fn threads(&self) -> Vec<Vec<Texel>> {
        self.values().iter().map(texels).collect()
    }
}

pub fn texels<T: Given>(given: &T) -> Vec<Texel> {
    let mut out = Vec::new();
    given.texels(&mut out);
    out
}

/// Prints what a kernel gives each pixel: `-` where it panics.
pub fn pixels(out: &mut Vec<u8>, kernel: &dyn Fn(IVec2) -> Vec<Texel>) {
    for y in 0..SIZE[1] as i32 {
        for x in 0..SIZE[0] as i32 {
            let run = std::panic::AssertUnwindSafe(|| kernel(ivec2(x, y)));
            pixel(out, std::panic::catch_unwind(run).ok().as_deref());
        }
    }
}

/// Runs a kernel of workgroups, as above.
pub fn groups<const W: usize, const H: usize>(out: &mut Vec<u8>, kernel: &dyn Fn(&Workgroup<W, H>) -> Vec<Vec<Texel>>) {
    let all: Vec<_> = Workgroup::<W, H>::all(uvec2(SIZE[0], SIZE[1]))
        .map(|group| std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| kernel(&group))).ok())
        .collect();
    let across = (SIZE[0] as usize).div_ceil(W);
    for y in 0..SIZE[1] as usize {
        for x in 0..SIZE[0] as usize {
            let threads = all[y / H * across + x / W].as_ref();
            let none = Vec::new();
            pixel(out, threads.map(|t| t.get(y % H * W + x % W).unwrap_or(&none).as_slice()));
        }
    }
}

fn pixel(out: &mut Vec<u8>, texels: Option<&[Texel]>) {
    match texels {
        Some(texels) => print(out, texels),
        None => out.extend_from_slice(b"-"),
    }
    out.push(b';');
}

/// Prints what a kernel has written.
pub fn buffer<T: Held>(out: &mut Vec<u8>, name: &str, elements: &[T]) {
    let elements: Vec<Texel> = elements.iter().map(Held::lanes).collect();
    out.extend_from_slice(format!("|{name}=").as_bytes());
    print(out, &elements);
}

fn print(out: &mut Vec<u8>, texels: &[Texel]) {
    for lane in texels.iter().flatten() {
        out.extend_from_slice(format!("{:x},", lane.to_bits()).as_bytes());
    }
}

fn main() {
    std::panic::set_hook(Box::new(|_| {}));
    // A text that is being made smaller may never end.
    std::thread::spawn(|| {
        std::thread::sleep(std::time::Duration::from_secs(30));
        std::process::exit(3);
    });
    let texels = TEXELS.chunks(4).map(|t| vec4(t[0], t[1], t[2], t[3])).collect();
    let size = uvec2(SIZE[0], SIZE[1]);
    let world = World {
        a: Frame::new(size, texels),
        b: Buffer::new(BUFFER.to_vec()),
        c: resources::Resources::new(size, &FLOATS, &BITS),
    };
    let mut out = Vec::new();
    for kernel in KERNELS {
        kernel(&world, &mut out);
        out.push(b'\n');
    }
    std::io::Write::write_all(&mut std::io::stdout(), &out).unwrap();
}
