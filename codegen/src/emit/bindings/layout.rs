//! Entries of a shader's bind group layout, as constants of wgpu.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use straightline_manifest::{Binding, BindingKind, BufferType, Format, SampleType, SamplerType, Stage, ViewDimension};

pub fn binding_entry(stage: Stage, binding: &Binding) -> TokenStream {
    let wgpu = quote! { wgpu };
    let number = Literal::u32_unsuffixed(binding.binding);
    let visibility = match stage {
        Stage::Compute => quote! { #wgpu::ShaderStages::COMPUTE },
        Stage::Fragment => quote! { #wgpu::ShaderStages::FRAGMENT },
    };
    let buffer = |ty: TokenStream, size: u32| {
        let size = Literal::u64_unsuffixed(size.into());
        quote! {
            #wgpu::BindingType::Buffer {
                ty: #ty,
                has_dynamic_offset: false,
                min_binding_size: #wgpu::BufferSize::new(#size),
            }
        }
    };
    let ty = match &binding.kind {
        BindingKind::Texture {
            dimension, sample_type, ..
        } => {
            let sample_type = match sample_type {
                SampleType::Unfilterable => quote! { #wgpu::TextureSampleType::Float { filterable: false } },
                SampleType::Filterable => quote! { #wgpu::TextureSampleType::Float { filterable: true } },
                SampleType::Depth => quote! { #wgpu::TextureSampleType::Depth },
                SampleType::Sint => quote! { #wgpu::TextureSampleType::Sint },
                SampleType::Uint => quote! { #wgpu::TextureSampleType::Uint },
            };
            let view = match dimension.view() {
                ViewDimension::D2Array => quote! { #wgpu::TextureViewDimension::D2Array },
                ViewDimension::D2 => quote! { #wgpu::TextureViewDimension::D2 },
                ViewDimension::D3 => quote! { #wgpu::TextureViewDimension::D3 },
                ViewDimension::Cube => quote! { #wgpu::TextureViewDimension::Cube },
            };
            let multisampled = dimension.is_multisampled();
            quote! {
                #wgpu::BindingType::Texture {
                    sample_type: #sample_type,
                    view_dimension: #view,
                    multisampled: #multisampled,
                }
            }
        }
        BindingKind::Sampler { sampler } => match sampler {
            SamplerType::Filtering => quote! { #wgpu::BindingType::Sampler(#wgpu::SamplerBindingType::Filtering) },
            SamplerType::NonFiltering => {
                quote! { #wgpu::BindingType::Sampler(#wgpu::SamplerBindingType::NonFiltering) }
            }
            SamplerType::Comparison => quote! { #wgpu::BindingType::Sampler(#wgpu::SamplerBindingType::Comparison) },
        },
        BindingKind::Buffer {
            stride, buffer_type, ..
        } => buffer(
            match buffer_type {
                BufferType::Storage => quote! { #wgpu::BufferBindingType::Storage { read_only: false } },
                _ => quote! { #wgpu::BufferBindingType::Storage { read_only: true } },
            },
            *stride,
        ),
        BindingKind::Uniform { size, .. } => buffer(quote! { #wgpu::BufferBindingType::Uniform }, *size),
    };
    quote! {
        #wgpu::BindGroupLayoutEntry { binding: #number, visibility: #visibility, ty: #ty, count: None }
    }
}

pub fn output_entry(binding: u32, format: Format) -> TokenStream {
    let number = Literal::u32_unsuffixed(binding);
    // wgpu's format names equal the manifest's.
    let format = format_ident!("{format:?}");
    let wgpu = quote! { wgpu };
    quote! {
        #wgpu::BindGroupLayoutEntry {
            binding: #number,
            visibility: #wgpu::ShaderStages::COMPUTE,
            ty: #wgpu::BindingType::StorageTexture {
                access: #wgpu::StorageTextureAccess::WriteOnly,
                format: #wgpu::TextureFormat::#format,
                view_dimension: #wgpu::TextureViewDimension::D2,
            },
            count: None,
        }
    }
}
