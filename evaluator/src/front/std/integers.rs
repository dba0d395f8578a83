impl i32 {
    fn abs_diff(self, other: i32) -> u32 {
        let (a, b) = (self as u32, other as u32);
        if self < other { b.wrapping_sub(a) } else { a.wrapping_sub(b) }
    }

    fn unsigned_abs(self) -> u32 {
        let bits = self as u32;
        if self < 0 { 0_u32.wrapping_sub(bits) } else { bits }
    }

    fn is_positive(self) -> bool {
        self > 0
    }

    fn is_negative(self) -> bool {
        self < 0
    }

    fn rem_euclid(self, divisor: i32) -> i32 {
        let rest = self % divisor;
        if rest < 0 { if divisor < 0 { rest.wrapping_sub(divisor) } else { rest.wrapping_add(divisor) } } else { rest }
    }

    fn div_euclid(self, divisor: i32) -> i32 {
        let whole = self / divisor;
        let below = self % divisor < 0;
        if below { if divisor > 0 { whole.wrapping_sub(1) } else { whole.wrapping_add(1) } } else { whole }
    }

    fn rotate_left(self, n: u32) -> i32 {
        ((self as u32) << (n & 31) | (self as u32) >> (32_u32.wrapping_sub(n) & 31)) as i32
    }

    fn rotate_right(self, n: u32) -> i32 {
        ((self as u32) >> (n & 31) | (self as u32) << (32_u32.wrapping_sub(n) & 31)) as i32
    }
}

impl u32 {
    fn abs_diff(self, other: u32) -> u32 {
        if self < other { other.wrapping_sub(self) } else { self.wrapping_sub(other) }
    }

    fn rem_euclid(self, divisor: u32) -> u32 {
        self % divisor
    }

    fn div_euclid(self, divisor: u32) -> u32 {
        self / divisor
    }

    fn div_ceil(self, divisor: u32) -> u32 {
        let whole = self / divisor;
        if self % divisor > 0 { whole + 1 } else { whole }
    }

    fn is_multiple_of(self, of: u32) -> bool {
        if of == 0 { self == 0 } else { self % of == 0 }
    }

    fn is_power_of_two(self) -> bool {
        self.count_ones() == 1
    }

    fn rotate_left(self, n: u32) -> u32 {
        self << (n & 31) | self >> (32_u32.wrapping_sub(n) & 31)
    }

    fn rotate_right(self, n: u32) -> u32 {
        self >> (n & 31) | self << (32_u32.wrapping_sub(n) & 31)
    }

    fn saturating_add(self, other: u32) -> u32 {
        let sum = self.wrapping_add(other);
        if sum < self { u32::MAX } else { sum }
    }

    fn saturating_sub(self, other: u32) -> u32 {
        if self > other { self.wrapping_sub(other) } else { 0 }
    }

    fn midpoint(self, other: u32) -> u32 {
        (self & other) + ((self ^ other) >> 1)
    }

    fn checked_add(self, other: u32) -> Option<u32> {
        let sum = self.wrapping_add(other);
        if sum < self { None } else { Some(sum) }
    }

    fn checked_sub(self, other: u32) -> Option<u32> {
        if self < other { None } else { Some(self.wrapping_sub(other)) }
    }
}

impl usize {
    fn abs_diff(self, other: usize) -> usize {
        if self < other { other - self } else { self - other }
    }

    fn div_ceil(self, divisor: usize) -> usize {
        let whole = self / divisor;
        if self % divisor > 0 { whole + 1 } else { whole }
    }

    fn is_multiple_of(self, of: usize) -> bool {
        if of == 0 { self == 0 } else { self % of == 0 }
    }

    fn is_power_of_two(self) -> bool {
        self.count_ones() == 1
    }

    fn midpoint(self, other: usize) -> usize {
        (self & other) + ((self ^ other) >> 1)
    }

    fn saturating_add(self, other: usize) -> usize {
        let sum = self.wrapping_add(other);
        if sum < self { usize::MAX } else { sum }
    }

    fn saturating_sub(self, other: usize) -> usize {
        if self > other { self - other } else { 0 }
    }

    fn checked_add(self, other: usize) -> Option<usize> {
        let sum = self.wrapping_add(other);
        if sum < self { None } else { Some(sum) }
    }

    fn checked_sub(self, other: usize) -> Option<usize> {
        if self < other { None } else { Some(self - other) }
    }

    fn leading_zeros(self) -> u32 {
        let high = ((self >> 16) >> 16) as u32;
        if high > 0 { high.leading_zeros() } else { (self as u32).leading_zeros() + 32 }
    }

    fn trailing_zeros(self) -> u32 {
        let low = self as u32;
        if low > 0 { low.trailing_zeros() } else { (((self >> 16) >> 16) as u32).trailing_zeros() + 32 }
    }

    fn ilog2(self) -> u32 {
        63_u32.wrapping_sub(self.leading_zeros())
    }

    fn checked_ilog2(self) -> Option<u32> {
        if self > 0 { Some(self.ilog2()) } else { None }
    }

    fn next_power_of_two(self) -> usize {
        if self <= 1 { 1 } else { 1_usize << (64_u32 - (self - 1).leading_zeros()) }
    }

    fn next_multiple_of(self, of: usize) -> usize {
        let rest = self % of;
        if rest == 0 { self } else { self + (of - rest) }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Ordering {
    Less,
    Equal,
    Greater,
}

impl Ordering {
    fn is_lt(self) -> bool {
        matches!(self, Ordering::Less)
    }

    fn is_le(self) -> bool {
        !matches!(self, Ordering::Greater)
    }

    fn is_gt(self) -> bool {
        matches!(self, Ordering::Greater)
    }

    fn is_ge(self) -> bool {
        !matches!(self, Ordering::Less)
    }

    fn is_eq(self) -> bool {
        matches!(self, Ordering::Equal)
    }

    fn is_ne(self) -> bool {
        !matches!(self, Ordering::Equal)
    }

    fn reverse(self) -> Ordering {
        match self {
            Ordering::Less => Ordering::Greater,
            Ordering::Equal => Ordering::Equal,
            Ordering::Greater => Ordering::Less,
        }
    }

    fn then(self, other: Ordering) -> Ordering {
        match self {
            Ordering::Equal => other,
            decided => decided,
        }
    }
}

impl f32 {
    fn total_cmp(&self, other: &f32) -> Ordering {
        let (a, b) = (self.to_bits() as i32, other.to_bits() as i32);
        let (a, b) = (a ^ (((a >> 31) as u32) >> 1) as i32, b ^ (((b >> 31) as u32) >> 1) as i32);
        a.cmp(&b)
    }

    fn partial_cmp(&self, other: &f32) -> Option<Ordering> {
        if *self < *other {
            Some(Ordering::Less)
        } else if *self == *other {
            Some(Ordering::Equal)
        } else if *self > *other {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
}

impl i32 {
    fn cmp(&self, other: &i32) -> Ordering {
        if *self < *other {
            Ordering::Less
        } else if *self == *other {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }
}

impl u32 {
    fn cmp(&self, other: &u32) -> Ordering {
        if *self < *other {
            Ordering::Less
        } else if *self == *other {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }
}

impl usize {
    fn cmp(&self, other: &usize) -> Ordering {
        if *self < *other {
            Ordering::Less
        } else if *self == *other {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }
}

impl u32 {
    fn ilog2(self) -> u32 {
        31_u32.wrapping_sub(self.leading_zeros())
    }

    fn isqrt(self) -> u32 {
        let near = ((self as f32).sqrt() as u32).min(65535);
        if near * near > self {
            near - 1
        } else if near < 65535 && (near + 1) * (near + 1) <= self {
            near + 1
        } else {
            near
        }
    }

    fn next_power_of_two(self) -> u32 {
        if self <= 1 { 1 } else { (u32::MAX >> (self - 1).leading_zeros()) + 1 }
    }

    fn swap_bytes(self) -> u32 {
        self << 24 | (self & 0xff00) << 8 | self >> 8 & 0xff00 | self >> 24
    }
}

impl i32 {
    fn ilog2(self) -> u32 {
        31_u32.wrapping_sub(self.leading_zeros())
    }

    fn wrapping_abs(self) -> i32 {
        if self < 0 { self.wrapping_neg() } else { self }
    }
}

impl u32 {
    fn to_le_bytes(self) -> [u8; 4] {
        [self as u8, (self >> 8) as u8, (self >> 16) as u8, (self >> 24) as u8]
    }

    fn to_be_bytes(self) -> [u8; 4] {
        [(self >> 24) as u8, (self >> 16) as u8, (self >> 8) as u8, self as u8]
    }

    fn to_ne_bytes(self) -> [u8; 4] {
        self.to_le_bytes()
    }

    fn from_le_bytes(bytes: [u8; 4]) -> u32 {
        bytes[0] as u32 | (bytes[1] as u32) << 8 | (bytes[2] as u32) << 16 | (bytes[3] as u32) << 24
    }

    fn from_be_bytes(bytes: [u8; 4]) -> u32 {
        (bytes[0] as u32) << 24 | (bytes[1] as u32) << 16 | (bytes[2] as u32) << 8 | bytes[3] as u32
    }

    fn from_ne_bytes(bytes: [u8; 4]) -> u32 {
        u32::from_le_bytes(bytes)
    }
}
