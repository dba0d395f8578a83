// Orientation for WebGPU: A mixture of the pixel, the one to its right and the one two rows below.
/// <reference types="@webgpu/types" />

/** What the filter reads. */
export interface Inputs {
    /** 2d, sample type unfilterable-float, of the target's size. */
    color: GPUTextureView;
}

export interface Filter {
    /** Set them before `encode`. They are written to the queue by `encode`: one set of them for each submission. */
    uniforms: {
        /** Weight of the pixel two rows below. */
        below: number;
    };
    /** Encodes one render pass that covers the target. */
    encode(encoder: GPUCommandEncoder, inputs: Inputs, target: GPUTextureView | GPUTextureView[]): void;
    dispose(): void;
}

/** Makes the pipeline for a target of this format. */
export function create(device: GPUDevice, format: GPUTextureFormat | GPUTextureFormat[]): Filter;
