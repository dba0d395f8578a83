#!/usr/bin/env kernel
pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
	/* ‮[31m   */ let é = missing /*  */ + gone;
    color.load(pixel)
}
