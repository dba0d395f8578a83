// Bloom for WebGPU: Adds a glow around what is brighter than `threshold`.
/// <reference types="@webgpu/types" />

/** A texture, or a view of one with its size, which the sizes of the passes depend on. */
export type Sized = GPUTexture | { view: GPUTextureView; width: number; height: number };

/** What the filter reads. */
export interface Inputs {
    /** 2d, sample type unfilterable-float. */
    color: Sized;
}

export interface Filter {
    /** Set them before `encode`. They are written to the queue by `encode`: one set of them for each submission. */
    uniforms: {
        threshold: number;
        strength: number;
    };
    /**
     * Encodes 2 render passes. The target has the size `color.size()`.
     * The textures between them are made for the sizes of the inputs, and again if these change: one size for each submission.
     */
    encode(encoder: GPUCommandEncoder, inputs: Inputs, target: GPUTextureView | GPUTextureView[]): void;
    /** Destroys the textures and buffers. */
    dispose(): void;
}

/** Makes the pipelines for a target of this format. */
export function create(device: GPUDevice, format: GPUTextureFormat | GPUTextureFormat[]): Filter;
