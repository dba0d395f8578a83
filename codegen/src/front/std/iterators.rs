impl Iterator {
    fn position<T>(items: [T], f: impl Fn(T) -> bool) -> Option<usize> {
        for (k, x) in items.into_iter().enumerate() {
            if f(x) {
                return Some(k);
            }
        }
        None
    }

    fn find<T>(items: [T], f: impl Fn(&T) -> bool) -> Option<T> {
        for x in items {
            if f(&x) {
                return Some(x);
            }
        }
        None
    }

    fn find_map<T, U>(items: [T], f: impl Fn(T) -> Option<U>) -> Option<U> {
        for x in items {
            let found = f(x);
            if found.is_some() {
                return found;
            }
        }
        None
    }
}

impl Array {
    fn first<T>(items: &[T]) -> Option<&T> {
        if items.len() > 0 { Some(&items[0]) } else { None }
    }

    fn last<T>(items: &[T]) -> Option<&T> {
        if items.len() > 0 { Some(&items[items.len() - 1]) } else { None }
    }

    fn get<T>(items: &[T], k: usize) -> Option<&T> {
        if k < items.len() { Some(&items[k]) } else { None }
    }

    fn contains<T>(items: &[T], x: &T) -> bool {
        for item in items {
            if *item == *x {
                return true;
            }
        }
        false
    }
}
