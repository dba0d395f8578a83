impl i32 {
    fn count_zeros(self) -> u32 {
        (!self).count_ones()
    }

    fn leading_ones(self) -> u32 {
        (!self).leading_zeros()
    }

    fn trailing_ones(self) -> u32 {
        (!self).trailing_zeros()
    }

    fn checked_mul(self, other: i32) -> Option<i32> {
        if self.multiplies(other) { Some(self.wrapping_mul(other)) } else { None }
    }

    fn checked_shl(self, n: u32) -> Option<i32> {
        if n < 32 { Some(self.wrapping_shl(n)) } else { None }
    }

    fn checked_shr(self, n: u32) -> Option<i32> {
        if n < 32 { Some(self.wrapping_shr(n)) } else { None }
    }

    fn unbounded_shl(self, n: u32) -> i32 {
        if n < 32 { self.wrapping_shl(n) } else { 0 }
    }

    fn overflowing_add(self, other: i32) -> (i32, bool) {
        (self.wrapping_add(other), self.checked_add(other).is_none())
    }

    fn overflowing_sub(self, other: i32) -> (i32, bool) {
        (self.wrapping_sub(other), self.checked_sub(other).is_none())
    }

    fn overflowing_mul(self, other: i32) -> (i32, bool) {
        (self.wrapping_mul(other), !self.multiplies(other))
    }

    fn checked_ilog2(self) -> Option<u32> {
        if self > 0 { Some(31 - self.leading_zeros()) } else { None }
    }

    fn ilog10(self) -> u32 {
        let mut power = 10;
        let mut n = 0;
        for _ in 0..9 {
            if self >= power {
                n += 1;
            }
            power = power.wrapping_mul(10);
        }
        n
    }

    fn checked_ilog10(self) -> Option<u32> {
        if self > 0 { Some(self.ilog10()) } else { None }
    }

    fn checked_rem(self, other: i32) -> Option<i32> {
        if self.divides_by(other) { Some(self % other) } else { None }
    }

    fn checked_div(self, other: i32) -> Option<i32> {
        if self.divides_by(other) { Some(self / other) } else { None }
    }

    fn checked_rem_euclid(self, other: i32) -> Option<i32> {
        if self.divides_by(other) { Some(self.rem_euclid(other)) } else { None }
    }

    fn checked_div_euclid(self, other: i32) -> Option<i32> {
        if self.divides_by(other) { Some(self.div_euclid(other)) } else { None }
    }
}
