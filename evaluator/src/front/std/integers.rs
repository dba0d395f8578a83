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
}
