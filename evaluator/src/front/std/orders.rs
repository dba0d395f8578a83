impl __Order {
    fn max<T>(a: T, b: T) -> T {
        if b < a { a } else { b }
    }

    fn min<T>(a: T, b: T) -> T {
        if b < a { b } else { a }
    }

    fn clamp<T>(x: T, low: T, high: T) -> T {
        if x < low {
            low
        } else if x > high {
            high
        } else {
            x
        }
    }

    fn cmp<T>(a: &T, b: &T) -> Ordering {
        if *a < *b {
            Ordering::Less
        } else if *a > *b {
            Ordering::Greater
        } else {
            Ordering::Equal
        }
    }

    fn partial_cmp<T>(a: &T, b: &T) -> Option<Ordering> {
        if *a < *b {
            Some(Ordering::Less)
        } else if *a > *b {
            Some(Ordering::Greater)
        } else if *a <= *b {
            Some(Ordering::Equal)
        } else {
            None
        }
    }
}
