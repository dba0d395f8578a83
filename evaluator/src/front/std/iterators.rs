fn successors<T>(last: Option<T>, f: impl Fn(&T) -> Option<T>) -> __Filtered<T> {
    __Filtered { items: [last.and_then(|x| f(&x)).map(|x| x)] }
}

struct __Filtered<T> {
    items: [Option<T>],
}

impl<T> __Filtered<T> {
    fn filter(self, f: impl Fn(&T) -> bool) -> __Filtered<T> {
        __Filtered { items: self.items.map(|x| x.filter(|x| f(x))) }
    }

    fn map<U>(self, f: impl Fn(T) -> U) -> __Filtered<U> {
        __Filtered { items: self.items.map(|x| x.map(|x| f(x))) }
    }

    fn filter_map<U>(self, f: impl Fn(T) -> Option<U>) -> __Filtered<U> {
        __Filtered { items: self.items.map(|x| x.and_then(|x| f(x))) }
    }

    fn copied(self) -> __Filtered<T> {
        self
    }

    fn cloned(self) -> __Filtered<T> {
        self
    }

    fn count(self) -> usize {
        let mut n = 0;
        for x in self.items {
            if x.is_some() {
                n += 1;
            }
        }
        n
    }

    fn sum(self) -> T {
        sum_of_some(self.items)
    }

    fn product(self) -> T {
        product_of_some(self.items)
    }

    fn fold<U>(self, first: U, f: impl Fn(U, T) -> U) -> U {
        let mut sum = first;
        for x in self.items {
            if let Some(x) = x {
                sum = f(sum, x);
            }
        }
        sum
    }

    fn for_each(self, f: impl Fn(T)) {
        for x in self.items {
            if let Some(x) = x {
                f(x);
            }
        }
    }

    fn any(self, f: impl Fn(T) -> bool) -> bool {
        for x in self.items {
            if let Some(x) = x {
                if f(x) {
                    return true;
                }
            }
        }
        false
    }

    fn all(self, f: impl Fn(T) -> bool) -> bool {
        for x in self.items {
            if let Some(x) = x {
                if !f(x) {
                    return false;
                }
            }
        }
        true
    }

    fn next(self) -> Option<T> {
        for x in self.items {
            if x.is_some() {
                return x;
            }
        }
        None
    }

    fn find(self, f: impl Fn(&T) -> bool) -> Option<T> {
        for x in self.items {
            if let Some(x) = x {
                if f(&x) {
                    return Some(x);
                }
            }
        }
        None
    }

    fn find_map<U>(self, f: impl Fn(T) -> Option<U>) -> Option<U> {
        for x in self.items {
            if let Some(x) = x {
                let found = f(x);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    fn position(self, f: impl Fn(T) -> bool) -> Option<usize> {
        let mut n = 0;
        for x in self.items {
            if let Some(x) = x {
                if f(x) {
                    return Some(n);
                }
                n += 1;
            }
        }
        None
    }

    fn reduce(self, f: impl Fn(T, T) -> T) -> Option<T> {
        let mut all = None;
        for x in self.items {
            if let Some(x) = x {
                all = match all {
                    None => Some(x),
                    Some(all) => Some(f(all, x)),
                };
            }
        }
        all
    }

    fn min(self) -> Option<T> {
        self.reduce(|least, x| if x < least { x } else { least })
    }

    fn max(self) -> Option<T> {
        self.reduce(|largest, x| if x < largest { largest } else { x })
    }

    fn min_by(self, f: impl Fn(&T, &T) -> Ordering) -> Option<T> {
        self.reduce(|least, x| if f(&least, &x).is_gt() { x } else { least })
    }

    fn max_by(self, f: impl Fn(&T, &T) -> Ordering) -> Option<T> {
        self.reduce(|largest, x| if f(&largest, &x).is_gt() { largest } else { x })
    }

    fn min_by_key<K>(self, f: impl Fn(&T) -> K) -> Option<T> {
        self.reduce(|least, x| if f(&x) < f(&least) { x } else { least })
    }

    fn max_by_key<K>(self, f: impl Fn(&T) -> K) -> Option<T> {
        self.reduce(|largest, x| if f(&x) < f(&largest) { largest } else { x })
    }

    fn last(self) -> Option<T> {
        let mut last = None;
        for x in self.items {
            if x.is_some() {
                last = x;
            }
        }
        last
    }
}

impl Iterator {
    fn filter<T>(items: [T], f: impl Fn(&T) -> bool) -> __Filtered<T> {
        __Filtered { items: items.map(|x| if f(&x) { Some(x) } else { None }) }
    }

    fn filter_map<T, U>(items: [T], f: impl Fn(T) -> Option<U>) -> __Filtered<U> {
        __Filtered { items: items.map(|x| f(x)) }
    }

    fn take_while<T>(items: [T], f: impl Fn(&T) -> bool) -> __Filtered<T> {
        let mut goes_on = true;
        let mut left = items.map(|x| Some(x));
        for k in 0..left.len() {
            goes_on = goes_on && f(&items[k]);
            if !goes_on {
                left[k] = None;
            }
        }
        __Filtered { items: left }
    }

    fn skip_while<T>(items: [T], f: impl Fn(&T) -> bool) -> __Filtered<T> {
        let mut skips = true;
        let mut left = items.map(|x| Some(x));
        for k in 0..left.len() {
            skips = skips && f(&items[k]);
            if skips {
                left[k] = None;
            }
        }
        __Filtered { items: left }
    }

    fn map_while<T, U>(items: [T], f: impl Fn(T) -> Option<U>) -> __Filtered<U> {
        let mut goes_on = true;
        let mut left = items.map(|x| f(x));
        for k in 0..left.len() {
            goes_on = goes_on && left[k].is_some();
            if !goes_on {
                left[k] = None;
            }
        }
        __Filtered { items: left }
    }

    fn is_sorted<T>(items: [T]) -> bool {
        Array::is_sorted(&items)
    }

    fn is_sorted_by<T>(items: [T], f: impl Fn(&T, &T) -> bool) -> bool {
        Array::is_sorted_by(&items, f)
    }

    fn rposition<T>(items: [T], f: impl Fn(T) -> bool) -> Option<usize> {
        let mut found = None;
        for k in 0..items.len() {
            if f(items[k]) {
                found = Some(k);
            }
        }
        found
    }

    fn min<T>(items: [T]) -> Option<T> {
        Iterator::reduce(items, |least, x| if x < least { x } else { least })
    }

    fn max<T>(items: [T]) -> Option<T> {
        Iterator::reduce(items, |largest, x| if x < largest { largest } else { x })
    }

    fn reduce<T>(items: [T], f: impl Fn(T, T) -> T) -> Option<T> {
        let mut all = None;
        for x in items {
            all = match all {
                None => Some(x),
                Some(all) => Some(f(all, x)),
            };
        }
        all
    }

    fn any<T>(items: [T], f: impl Fn(T) -> bool) -> bool {
        for x in items {
            if f(x) {
                return true;
            }
        }
        false
    }

    fn all<T>(items: [T], f: impl Fn(T) -> bool) -> bool {
        for x in items {
            if !f(x) {
                return false;
            }
        }
        true
    }

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

    fn last<T>(items: [T]) -> Option<T> {
        let mut found = None;
        for x in items {
            found = Some(x);
        }
        found
    }

    fn nth<T>(items: [T], n: usize) -> Option<T> {
        for (k, x) in items.into_iter().enumerate() {
            if k == n {
                return Some(x);
            }
        }
        None
    }

    fn min_by<T>(items: [T], f: impl Fn(&T, &T) -> Ordering) -> Option<T> {
        Iterator::reduce(items, |least, x| if f(&least, &x).is_gt() { x } else { least })
    }

    fn max_by<T>(items: [T], f: impl Fn(&T, &T) -> Ordering) -> Option<T> {
        Iterator::reduce(items, |largest, x| if f(&largest, &x).is_gt() { largest } else { x })
    }

    fn min_by_key<T, K>(items: [T], f: impl Fn(&T) -> K) -> Option<T> {
        Iterator::reduce(items, |least, x| if f(&x) < f(&least) { x } else { least })
    }

    fn max_by_key<T, K>(items: [T], f: impl Fn(&T) -> K) -> Option<T> {
        Iterator::reduce(items, |largest, x| if f(&x) < f(&largest) { largest } else { x })
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
    fn swap<T>(items: &mut [T], a: usize, b: usize) {
        let first = items[a];
        items[a] = items[b];
        items[b] = first;
    }

    fn reverse<T>(items: &mut [T]) {
        for k in 0..items.len() / 2 {
            let first = items[k];
            items[k] = items[items.len() - 1 - k];
            items[items.len() - 1 - k] = first;
        }
    }

    fn fill<T>(items: &mut [T], value: T) {
        for k in 0..items.len() {
            items[k] = value;
        }
    }

    fn sort<T>(items: &mut [T]) {
        Array::sort_unstable(items);
    }

    fn sort_unstable<T>(items: &mut [T]) {
        for i in 1..items.len() {
            for j in (1..=i).rev() {
                if items[j] < items[j - 1] {
                    Array::swap(items, j - 1, j);
                }
            }
        }
    }

    fn sort_by<T>(items: &mut [T], f: impl Fn(&T, &T) -> Ordering) {
        for i in 1..items.len() {
            for j in (1..=i).rev() {
                if f(&items[j - 1], &items[j]).is_gt() {
                    Array::swap(items, j - 1, j);
                }
            }
        }
    }

    fn sort_unstable_by<T>(items: &mut [T], f: impl Fn(&T, &T) -> Ordering) {
        Array::sort_by(items, f);
    }

    fn sort_by_key<T, K>(items: &mut [T], f: impl Fn(&T) -> K) {
        for i in 1..items.len() {
            for j in (1..=i).rev() {
                if f(&items[j]) < f(&items[j - 1]) {
                    Array::swap(items, j - 1, j);
                }
            }
        }
    }

    fn copy_from_slice<T>(items: &mut [T], from: &[T]) {
        assert!(items.len() == from.len(), "the slices have different lengths");
        for k in 0..items.len() {
            items[k] = from[k];
        }
    }

    fn is_empty<T>(items: &[T]) -> bool {
        items.len() == 0
    }

    fn first<T>(items: &[T]) -> Option<&T> {
        if items.len() > 0 { Some(&items[0]) } else { None }
    }

    fn last<T>(items: &[T]) -> Option<&T> {
        if items.len() > 0 { Some(&items[items.len() - 1]) } else { None }
    }

    fn get<T>(items: &[T], k: usize) -> Option<&T> {
        if k < items.len() { Some(&items[k]) } else { None }
    }

    fn split_at<T>(items: &[T], k: usize) -> (&[T], &[T]) {
        (&items[..k], &items[k..])
    }

    fn split_at_checked<T>(items: &[T], k: usize) -> Option<(&[T], &[T])> {
        if k <= items.len() { Some((&items[..k], &items[k..])) } else { None }
    }

    fn split_first<T>(items: &[T]) -> Option<(&T, &[T])> {
        if items.len() > 0 { Some((&items[0], &items[1..])) } else { None }
    }

    fn split_last<T>(items: &[T]) -> Option<(&T, &[T])> {
        if items.len() > 0 { Some((&items[items.len() - 1], &items[..items.len() - 1])) } else { None }
    }

    fn first_mut<T>(items: &mut [T]) -> Option<&mut T> {
        if items.len() > 0 { Some(&mut items[0]) } else { None }
    }

    fn last_mut<T>(items: &mut [T]) -> Option<&mut T> {
        let n = items.len();
        if n > 0 { Some(&mut items[n - 1]) } else { None }
    }

    fn get_mut<T>(items: &mut [T], k: usize) -> Option<&mut T> {
        if k < items.len() { Some(&mut items[k]) } else { None }
    }

    fn split_at_mut<T>(items: &mut [T], k: usize) -> (&mut [T], &mut [T]) {
        (&mut items[..k], &mut items[k..])
    }

    fn split_first_mut<T>(items: &mut [T]) -> Option<(&mut T, &mut [T])> {
        if items.len() > 0 { Some((&mut items[0], &mut items[1..])) } else { None }
    }

    fn split_last_mut<T>(items: &mut [T]) -> Option<(&mut T, &mut [T])> {
        let n = items.len();
        if n > 0 { Some((&mut items[n - 1], &mut items[..n - 1])) } else { None }
    }

    fn as_slice<T>(items: &[T]) -> &[T] {
        &items[..]
    }

    fn contains<T>(items: &[T], x: &T) -> bool {
        for item in items {
            if *item == *x {
                return true;
            }
        }
        false
    }

    fn starts_with<T>(items: &[T], start: &[T]) -> bool {
        if start.len() > items.len() {
            return false;
        }
        for k in 0..start.len() {
            if items[k] != start[k] {
                return false;
            }
        }
        true
    }

    fn ends_with<T>(items: &[T], end: &[T]) -> bool {
        if end.len() > items.len() {
            return false;
        }
        for k in 0..end.len() {
            if items[items.len() - end.len() + k] != end[k] {
                return false;
            }
        }
        true
    }

    fn is_sorted<T>(items: &[T]) -> bool {
        for k in 1..items.len() {
            if !(items[k - 1] <= items[k]) {
                return false;
            }
        }
        true
    }

    fn is_sorted_by<T>(items: &[T], f: impl Fn(&T, &T) -> bool) -> bool {
        for k in 1..items.len() {
            if !f(&items[k - 1], &items[k]) {
                return false;
            }
        }
        true
    }

    fn rotate_left<T>(items: &mut [T], n: usize) {
        for _ in 0..n {
            for k in 1..items.len() {
                Array::swap(items, k - 1, k);
            }
        }
    }

    fn rotate_right<T>(items: &mut [T], n: usize) {
        Array::rotate_left(items, items.len() - n);
    }

    fn fill_with<T>(items: &mut [T], f: impl Fn() -> T) {
        for k in 0..items.len() {
            items[k] = f();
        }
    }

    fn clone_from_slice<T>(items: &mut [T], from: &[T]) {
        assert!(items.len() == from.len(), "the slices have different lengths");
        for k in 0..items.len() {
            items[k] = from[k];
        }
    }

    fn swap_with_slice<T>(items: &mut [T], other: &mut [T]) {
        assert!(items.len() == other.len(), "the slices have different lengths");
        for k in 0..items.len() {
            let item = items[k];
            items[k] = other[k];
            other[k] = item;
        }
    }

    fn sort_unstable_by_key<T, K>(items: &mut [T], f: impl Fn(&T) -> K) {
        Array::sort_by_key(items, f);
    }
}
