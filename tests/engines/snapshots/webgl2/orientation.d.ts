// Orientation for WebGL 2: A mixture of the pixel, the one to its right and the one two rows below.

/** What the filter reads. */
export interface Inputs {
    /** 2d, float, of the target's size. */
    color: WebGLTexture;
}

/** Where it draws: the canvas, unless a framebuffer is given. */
export interface Target {
    framebuffer?: WebGLFramebuffer | null;
    /** Pixels; those of the canvas by default. */
    width?: number;
    height?: number;
}

export interface Filter {
    /** Set them before `draw`. */
    uniforms: {
        /** Weight of the pixel two rows below. */
        below: number;
    };
    /** Draws one triangle over the target. Leaves blending, depth, stencil, scissor and culling off. */
    draw(inputs: Inputs, target?: Target): void;
    dispose(): void;
}

/** Compiles the shader. Throws with the driver's message if that fails. */
export function create(gl: WebGL2RenderingContext): Filter;
