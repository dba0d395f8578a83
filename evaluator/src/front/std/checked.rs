impl i32 {
    fn multiplies(self, other: i32) -> bool {
        let least = (self == -1 && other == i32::MIN) || (other == -1 && self == i32::MIN);
        let divisor = if self == 0 || least { 1 } else { self };
        self == 0 || (!least && self.wrapping_mul(other) / divisor == other)
    }

    fn divides_by(self, other: i32) -> bool {
        other != 0 && !(self == i32::MIN && other == -1)
    }

    fn cast_unsigned(self) -> u32 {
        self as u32
    }

    fn checked_add(self, other: i32) -> Option<i32> {
        let sum = self.wrapping_add(other);
        if (self ^ sum) & (other ^ sum) < 0 { None } else { Some(sum) }
    }

    fn checked_sub(self, other: i32) -> Option<i32> {
        let rest = self.wrapping_sub(other);
        if (self ^ other) & (self ^ rest) < 0 { None } else { Some(rest) }
    }

    fn saturating_add(self, other: i32) -> i32 {
        let sum = self.wrapping_add(other);
        let limit = if self < 0 { i32::MIN } else { i32::MAX };
        if (self ^ sum) & (other ^ sum) < 0 { limit } else { sum }
    }

    fn saturating_sub(self, other: i32) -> i32 {
        let rest = self.wrapping_sub(other);
        let limit = if self < 0 { i32::MIN } else { i32::MAX };
        if (self ^ other) & (self ^ rest) < 0 { limit } else { rest }
    }

    fn saturating_mul(self, other: i32) -> i32 {
        let limit = if (self < 0) == (other < 0) { i32::MAX } else { i32::MIN };
        if self.multiplies(other) { self.wrapping_mul(other) } else { limit }
    }

    fn saturating_div(self, other: i32) -> i32 {
        if self == i32::MIN && other == -1 { i32::MAX } else { self.wrapping_div(other) }
    }

    fn saturating_abs(self) -> i32 {
        if self == i32::MIN { i32::MAX } else { self.wrapping_abs() }
    }

    fn saturating_neg(self) -> i32 {
        if self == i32::MIN { i32::MAX } else { self.wrapping_neg() }
    }

    fn checked_abs(self) -> Option<i32> {
        if self == i32::MIN { None } else { Some(self.wrapping_abs()) }
    }

    fn checked_neg(self) -> Option<i32> {
        if self == i32::MIN { None } else { Some(self.wrapping_neg()) }
    }

    fn overflowing_abs(self) -> (i32, bool) {
        (self.wrapping_abs(), self == i32::MIN)
    }

    fn overflowing_neg(self) -> (i32, bool) {
        (self.wrapping_neg(), self == i32::MIN)
    }

    fn wrapping_div(self, other: i32) -> i32 {
        if other == -1 { self.wrapping_neg() } else { self / other }
    }

    fn wrapping_rem(self, other: i32) -> i32 {
        if other == -1 { 0 } else { self % other }
    }

    fn wrapping_div_euclid(self, other: i32) -> i32 {
        if other == -1 { self.wrapping_neg() } else { self.div_euclid(other) }
    }

    fn wrapping_rem_euclid(self, other: i32) -> i32 {
        if other == -1 { 0 } else { self.rem_euclid(other) }
    }

    fn wrapping_add_unsigned(self, other: u32) -> i32 {
        self.wrapping_add(other as i32)
    }

    fn wrapping_sub_unsigned(self, other: u32) -> i32 {
        self.wrapping_sub(other as i32)
    }

    fn checked_add_unsigned(self, other: u32) -> Option<i32> {
        let sum = self.wrapping_add(other as i32);
        if sum < self { None } else { Some(sum) }
    }

    fn checked_sub_unsigned(self, other: u32) -> Option<i32> {
        let rest = self.wrapping_sub(other as i32);
        if rest > self { None } else { Some(rest) }
    }

    fn saturating_add_unsigned(self, other: u32) -> i32 {
        let sum = self.wrapping_add(other as i32);
        if sum < self { i32::MAX } else { sum }
    }

    fn saturating_sub_unsigned(self, other: u32) -> i32 {
        let rest = self.wrapping_sub(other as i32);
        if rest > self { i32::MIN } else { rest }
    }

    fn unbounded_shr(self, n: u32) -> i32 {
        self.wrapping_shr(n.min(31))
    }

    fn midpoint(self, other: i32) -> i32 {
        let low = ((self ^ other) >> 1) + (self & other);
        if low < 0 && (self ^ other) & 1 == 1 { low + 1 } else { low }
    }

    fn isqrt(self) -> i32 {
        (self as u32).isqrt() as i32
    }

    fn checked_isqrt(self) -> Option<i32> {
        if self < 0 { None } else { Some(self.isqrt()) }
    }
}

impl u32 {
    fn multiplies(self, other: u32) -> bool {
        let divisor = if self == 0 { 1 } else { self };
        self == 0 || self.wrapping_mul(other) / divisor == other
    }

    fn divides_by(self, other: u32) -> bool {
        other != 0
    }

    fn cast_signed(self) -> i32 {
        self as i32
    }

    fn saturating_mul(self, other: u32) -> u32 {
        if self.multiplies(other) { self.wrapping_mul(other) } else { u32::MAX }
    }

    fn saturating_div(self, other: u32) -> u32 {
        self / other
    }

    fn wrapping_div(self, other: u32) -> u32 {
        self / other
    }

    fn wrapping_rem(self, other: u32) -> u32 {
        self % other
    }

    fn wrapping_div_euclid(self, other: u32) -> u32 {
        self / other
    }

    fn wrapping_rem_euclid(self, other: u32) -> u32 {
        self % other
    }

    fn wrapping_add_signed(self, other: i32) -> u32 {
        self.wrapping_add(other as u32)
    }

    fn checked_add_signed(self, other: i32) -> Option<u32> {
        let sum = self.wrapping_add(other as u32);
        if (other < 0) == (sum < self) { Some(sum) } else { None }
    }

    fn saturating_add_signed(self, other: i32) -> u32 {
        let sum = self.wrapping_add(other as u32);
        let limit = if other < 0 { 0 } else { u32::MAX };
        if (other < 0) == (sum < self) { sum } else { limit }
    }

    fn unbounded_shr(self, n: u32) -> u32 {
        if n < 32 { self.wrapping_shr(n) } else { 0 }
    }

    fn checked_neg(self) -> Option<u32> {
        if self == 0 { Some(0) } else { None }
    }

    fn overflowing_neg(self) -> (u32, bool) {
        (self.wrapping_neg(), self != 0)
    }

    fn checked_next_multiple_of(self, of: u32) -> Option<u32> {
        if of == 0 { None } else { self.div_ceil(of).checked_mul(of) }
    }

    fn next_multiple_of(self, of: u32) -> u32 {
        self.div_ceil(of).wrapping_mul(of)
    }

    fn checked_next_power_of_two(self) -> Option<u32> {
        if self > 0x8000_0000 { None } else { Some(self.next_power_of_two()) }
    }
}
