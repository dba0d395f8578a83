#[derive(Clone, Copy)]
struct Thread {
    local: IVec2,
    index: usize,
    pixel: IVec2,
    inside: bool,
}

struct PerThread<T> {
    value: T,
}

impl<T> PerThread<T> {
    fn of(&self, _thread: Thread) -> T {
        self.value
    }
}

struct Workgroup {
    origin: IVec2,
    thread: Thread,
}

impl Workgroup {
    fn origin(&self) -> IVec2 {
        self.origin
    }

    fn each<T>(&self, f: impl Fn(Thread) -> T) -> PerThread<T> {
        PerThread { value: f(self.thread) }
    }
}
