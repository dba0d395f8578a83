impl f32 {
    fn default() -> f32 {
        0.0
    }
}

impl i32 {
    fn default() -> i32 {
        0
    }
}

impl u32 {
    fn default() -> u32 {
        0
    }
}

impl usize {
    fn default() -> usize {
        0
    }
}

impl bool {
    fn default() -> bool {
        false
    }
}

impl Mat2 {
    fn default() -> Mat2 {
        Mat2::IDENTITY
    }
}

impl Mat3 {
    fn default() -> Mat3 {
        Mat3::IDENTITY
    }
}

impl Mat4 {
    fn default() -> Mat4 {
        Mat4::IDENTITY
    }
}

impl<T> Option<T> {
    fn default() -> Option<T> {
        None
    }
}

impl<T: Default> Option<T> {
    fn unwrap_or_default(self) -> T {
        match self {
            Some(x) => x,
            None => T::default(),
        }
    }
}

impl u8 {
    fn default() -> u8 {
        0
    }
}

impl u16 {
    fn default() -> u16 {
        0
    }
}

impl i8 {
    fn default() -> i8 {
        0
    }
}

impl i16 {
    fn default() -> i16 {
        0
    }
}
