#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Option<T> {
    None,
    Some(T),
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Result<T, E> {
    Ok(T),
    Err(E),
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct PhantomData<T>;

impl<T> Option<T> {
    fn is_some(&self) -> bool {
        matches!(self, Some(_))
    }

    fn is_none(&self) -> bool {
        matches!(self, None)
    }

    fn is_some_and(self, f: impl Fn(T) -> bool) -> bool {
        match self {
            Some(x) => f(x),
            None => false,
        }
    }

    fn is_none_or(self, f: impl Fn(T) -> bool) -> bool {
        match self {
            Some(x) => f(x),
            None => true,
        }
    }

    fn unwrap_or(self, other: T) -> T {
        match self {
            Some(x) => x,
            None => other,
        }
    }

    fn unwrap_or_else(self, f: impl Fn() -> T) -> T {
        match self {
            Some(x) => x,
            None => f(),
        }
    }

    fn map<U>(self, f: impl Fn(T) -> U) -> Option<U> {
        match self {
            Some(x) => Some(f(x)),
            None => None,
        }
    }

    fn map_or<U>(self, other: U, f: impl Fn(T) -> U) -> U {
        match self {
            Some(x) => f(x),
            None => other,
        }
    }

    fn map_or_else<U>(self, other: impl Fn() -> U, f: impl Fn(T) -> U) -> U {
        match self {
            Some(x) => f(x),
            None => other(),
        }
    }

    fn and<U>(self, other: Option<U>) -> Option<U> {
        match self {
            Some(_) => other,
            None => None,
        }
    }

    fn and_then<U>(self, f: impl Fn(T) -> Option<U>) -> Option<U> {
        match self {
            Some(x) => f(x),
            None => None,
        }
    }

    fn or(self, other: Option<T>) -> Option<T> {
        match self {
            Some(x) => Some(x),
            None => other,
        }
    }

    fn or_else(self, f: impl Fn() -> Option<T>) -> Option<T> {
        match self {
            Some(x) => Some(x),
            None => f(),
        }
    }

    fn xor(self, other: Option<T>) -> Option<T> {
        match (self, other) {
            (Some(x), None) => Some(x),
            (None, Some(y)) => Some(y),
            _ => None,
        }
    }

    fn filter(self, f: impl Fn(&T) -> bool) -> Option<T> {
        match self {
            Some(x) => if f(&x) { Some(x) } else { None },
            None => None,
        }
    }

    fn zip<U>(self, other: Option<U>) -> Option<(T, U)> {
        match (self, other) {
            (Some(x), Some(y)) => Some((x, y)),
            _ => None,
        }
    }

    fn ok_or<E>(self, error: E) -> Result<T, E> {
        match self {
            Some(x) => Ok(x),
            None => Err(error),
        }
    }

    fn ok_or_else<E>(self, f: impl Fn() -> E) -> Result<T, E> {
        match self {
            Some(x) => Ok(x),
            None => Err(f()),
        }
    }

    fn as_ref(&self) -> Option<&T> {
        match self {
            Some(x) => Some(x),
            None => None,
        }
    }
}

impl<T> Option<&T> {
    fn copied(self) -> Option<T> {
        match self {
            Some(x) => Some(*x),
            None => None,
        }
    }

    fn cloned(self) -> Option<T> {
        match self {
            Some(x) => Some(*x),
            None => None,
        }
    }
}

impl<T> Option<Option<T>> {
    fn flatten(self) -> Option<T> {
        match self {
            Some(x) => x,
            None => None,
        }
    }
}

impl<T, E> Result<T, E> {
    fn is_ok(&self) -> bool {
        matches!(self, Ok(_))
    }

    fn is_err(&self) -> bool {
        matches!(self, Err(_))
    }

    fn ok(self) -> Option<T> {
        match self {
            Ok(x) => Some(x),
            Err(_) => None,
        }
    }

    fn err(self) -> Option<E> {
        match self {
            Ok(_) => None,
            Err(e) => Some(e),
        }
    }

    fn unwrap_or(self, other: T) -> T {
        match self {
            Ok(x) => x,
            Err(_) => other,
        }
    }

    fn unwrap_or_else(self, f: impl Fn(E) -> T) -> T {
        match self {
            Ok(x) => x,
            Err(e) => f(e),
        }
    }

    fn map<U>(self, f: impl Fn(T) -> U) -> Result<U, E> {
        match self {
            Ok(x) => Ok(f(x)),
            Err(e) => Err(e),
        }
    }

    fn map_err<F>(self, f: impl Fn(E) -> F) -> Result<T, F> {
        match self {
            Ok(x) => Ok(x),
            Err(e) => Err(f(e)),
        }
    }

    fn and_then<U>(self, f: impl Fn(T) -> Result<U, E>) -> Result<U, E> {
        match self {
            Ok(x) => f(x),
            Err(e) => Err(e),
        }
    }
}

impl bool {
    fn then_some<T>(self, x: T) -> Option<T> {
        if self { Some(x) } else { None }
    }

    fn then<T>(self, f: impl Fn() -> T) -> Option<T> {
        if self { Some(f()) } else { None }
    }
}

impl<T> Option<T> {
    fn take(&mut self) -> Option<T> {
        let old = *self;
        *self = None;
        old
    }

    fn replace(&mut self, x: T) -> Option<T> {
        let old = *self;
        *self = Some(x);
        old
    }

    fn insert(&mut self, x: T) {
        *self = Some(x);
    }
}

impl<T, E> Result<T, E> {
    fn is_ok_and(self, f: impl Fn(T) -> bool) -> bool {
        match self {
            Ok(x) => f(x),
            Err(_) => false,
        }
    }

    fn is_err_and(self, f: impl Fn(E) -> bool) -> bool {
        match self {
            Ok(_) => false,
            Err(e) => f(e),
        }
    }

    fn map_or<U>(self, other: U, f: impl Fn(T) -> U) -> U {
        match self {
            Ok(x) => f(x),
            Err(_) => other,
        }
    }

    fn map_or_else<U>(self, other: impl Fn(E) -> U, f: impl Fn(T) -> U) -> U {
        match self {
            Ok(x) => f(x),
            Err(e) => other(e),
        }
    }

    fn and<U>(self, other: Result<U, E>) -> Result<U, E> {
        match self {
            Ok(_) => other,
            Err(e) => Err(e),
        }
    }

    fn or<F>(self, other: Result<T, F>) -> Result<T, F> {
        match self {
            Ok(x) => Ok(x),
            Err(_) => other,
        }
    }

    fn or_else<F>(self, f: impl Fn(E) -> Result<T, F>) -> Result<T, F> {
        match self {
            Ok(x) => Ok(x),
            Err(e) => f(e),
        }
    }
}

impl<T: Default, E> Result<T, E> {
    fn unwrap_or_default(self) -> T {
        match self {
            Ok(x) => x,
            Err(_) => T::default(),
        }
    }
}
