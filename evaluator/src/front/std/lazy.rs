impl __Lazy {
    fn fold<T, U>(items: [T], first: U, f: impl Fn(U, T) -> U) -> U {
        let mut sum = first;
        for x in items {
            sum = f(sum, x);
        }
        sum
    }

    fn for_each<T>(items: [T], f: impl Fn(T)) {
        for x in items {
            f(x);
        }
    }

    fn count<T>(items: [T]) -> usize {
        let mut n = 0_usize;
        for _ in items {
            n += 1;
        }
        n
    }

    fn position<T>(items: [T], f: impl Fn(T) -> bool) -> Option<usize> {
        let mut k = 0_usize;
        for x in items {
            if f(x) {
                return Some(k);
            }
            k += 1;
        }
        None
    }

    fn nth<T>(items: [T], n: usize) -> Option<T> {
        let mut k = 0_usize;
        for x in items {
            if k == n {
                return Some(x);
            }
            k += 1;
        }
        None
    }

    fn sum<T>(items: [T], first: T) -> T {
        let mut sum = first;
        for x in items {
            sum += x;
        }
        sum
    }

    fn product<T>(items: [T], first: T) -> T {
        let mut product = first;
        for x in items {
            product *= x;
        }
        product
    }
}
