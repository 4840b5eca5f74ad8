// WGSL, on a device of WebGPU.

export async function open(gpu) {
    const adapter = await gpu.requestAdapter();
    if (!adapter) throw Error("WebGPU has no adapter");
    const { vendor, architecture, description } = adapter.info;
    return new Device(await adapter.requestDevice(), description || `${vendor} ${architecture}`);
}

class Device {
    constructor(device, name) {
        this.device = device;
        this.name = name;
    }

    // Warnings are errors.
    async compile(code) {
        const module = this.device.createShaderModule({ code });
        const { messages } = await module.getCompilationInfo();
        if (messages.length) throw Error(messages.map((m) => `${m.type}: ${m.lineNum}: ${m.message}`).join("; "));
        return this.device.createComputePipelineAsync({ layout: "auto", compute: { module, entryPoint: "main" } });
    }

    buffer(size, usage) {
        return this.device.createBuffer({ size, usage });
    }

    async run(job, input) {
        const pipeline = await this.compile(job.text);
        const size = job.count * job.written * 4;
        const words = this.buffer(input.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
        const results = this.buffer(size, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
        const read = this.buffer(size, GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST);
        this.device.queue.writeBuffer(words, 0, input);
        const entries = [words, results].map((buffer, binding) => ({ binding, resource: { buffer } }));
        const group = this.device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
        const commands = this.device.createCommandEncoder();
        const pass = commands.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.dispatchWorkgroups(Math.ceil(job.count / 256));
        pass.end();
        commands.copyBufferToBuffer(results, 0, read, 0, size);
        this.device.queue.submit([commands.finish()]);
        await read.mapAsync(GPUMapMode.READ);
        const output = read.getMappedRange().slice(0);
        for (const buffer of [words, results, read]) buffer.destroy();
        return output;
    }
}
