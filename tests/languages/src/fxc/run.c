// Compiles HLSL by Microsoft's compiler and runs it by Direct3D 11: run.exe DLL FOLDER GROUPS, with includes from the folder.
//
// Of each kernel the standard input has four numbers: the bytes of its text, of its input and of its output, and the
// compiler's flags; then text and input. For each the standard output gets the bytes of what was said and of the
// output; then both. Nothing runs where an error was said. Whatever else fails ends the program.

#define COBJMACROS
#include <d3d11.h>
#include <d3dcompiler.h>
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static ID3D11Device* device;
static ID3D11DeviceContext* context;

static void check(HRESULT status, const char* what) {
    if (SUCCEEDED(status)) return;
    fprintf(stderr, "run.exe: %s: error %08lx\n", what, (unsigned long)status);
    exit(1);
}

// As many bytes of the standard input.
static void* taken(UINT size) {
    void* bytes = malloc(size + 1);
    check(bytes && fread(bytes, 1, size, stdin) == size ? S_OK : E_FAIL, "reading");
    return bytes;
}

static ID3D11Buffer* buffer(D3D11_USAGE usage, UINT bind, UINT access, UINT size, const void* contents) {
    const UINT kind = bind ? D3D11_RESOURCE_MISC_BUFFER_STRUCTURED : 0;
    const D3D11_BUFFER_DESC description = {size, usage, bind, access, kind, bind ? sizeof(UINT) : 0};
    const D3D11_SUBRESOURCE_DATA data = {contents, 0, 0};
    ID3D11Buffer* made;
    check(ID3D11Device_CreateBuffer(device, &description, contents ? &data : NULL, &made), "CreateBuffer");
    return made;
}

// Runs a module over the buffers t0 and u1, and writes out the latter.
static void run(ID3DBlob* module, UINT groups, const void* input, UINT read, UINT written) {
    ID3D11ComputeShader* shader;
    ID3D11Buffer* words = buffer(D3D11_USAGE_DEFAULT, D3D11_BIND_SHADER_RESOURCE, 0, read, input);
    ID3D11Buffer* results = buffer(D3D11_USAGE_DEFAULT, D3D11_BIND_UNORDERED_ACCESS, 0, written, NULL);
    ID3D11Buffer* copy = buffer(D3D11_USAGE_STAGING, 0, D3D11_CPU_ACCESS_READ, written, NULL);
    ID3D11ShaderResourceView* from;
    ID3D11UnorderedAccessView* to;
    D3D11_MAPPED_SUBRESOURCE mapped;
    const void* code = ID3D10Blob_GetBufferPointer(module);
    check(ID3D11Device_CreateComputeShader(device, code, ID3D10Blob_GetBufferSize(module), NULL, &shader), "the module");
    check(ID3D11Device_CreateShaderResourceView(device, (ID3D11Resource*)words, NULL, &from), "the view of t0");
    check(ID3D11Device_CreateUnorderedAccessView(device, (ID3D11Resource*)results, NULL, &to), "the view of u1");
    ID3D11DeviceContext_CSSetShader(context, shader, NULL, 0);
    ID3D11DeviceContext_CSSetShaderResources(context, 0, 1, &from);
    ID3D11DeviceContext_CSSetUnorderedAccessViews(context, 1, 1, &to, NULL);
    ID3D11DeviceContext_Dispatch(context, groups, 1, 1);
    ID3D11DeviceContext_CopyResource(context, (ID3D11Resource*)copy, (ID3D11Resource*)results);
    check(ID3D11DeviceContext_Map(context, (ID3D11Resource*)copy, 0, D3D11_MAP_READ, 0, &mapped), "Map");
    fwrite(mapped.pData, 1, written, stdout);
    ID3D11DeviceContext_Unmap(context, (ID3D11Resource*)copy, 0);
    ID3D11DeviceContext_ClearState(context);
    ID3D11ShaderResourceView_Release(from);
    ID3D11UnorderedAccessView_Release(to);
    ID3D11Buffer_Release(words);
    ID3D11Buffer_Release(results);
    ID3D11Buffer_Release(copy);
    ID3D11ComputeShader_Release(shader);
}

int main(int count, char** arguments) {
    if (count != 4) return 2;
    // Wine's own file of that name does not know all of HLSL.
    HMODULE library = LoadLibraryA(arguments[1]);
    pD3DCompile compile = library ? (pD3DCompile)(void*)GetProcAddress(library, "D3DCompile") : NULL;
    check(compile ? S_OK : E_FAIL, arguments[1]);
    const D3D_FEATURE_LEVEL level = D3D_FEATURE_LEVEL_11_0;
    check(D3D11CreateDevice(NULL, D3D_DRIVER_TYPE_HARDWARE, NULL, 0, &level, 1, D3D11_SDK_VERSION, &device, NULL, &context),
        "Direct3D 11");
    // Includes are sought in the folder of the text.
    char name[MAX_PATH];
    snprintf(name, sizeof name, "%s\\kernel.hlsl", arguments[2]);
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);

    UINT sizes[4];
    while (fread(sizes, sizeof sizes, 1, stdin) == 1) {
        char* text = taken(sizes[0]);
        void* input = taken(sizes[1]);
        ID3DBlob *module = NULL, *said = NULL;
        compile(text, sizes[0], name, NULL, D3D_COMPILE_STANDARD_FILE_INCLUDE, "main", "cs_5_0", sizes[3], 0, &module, &said);
        const char* words = said ? ID3D10Blob_GetBufferPointer(said) : "";
        const UINT reply[2] = {(UINT)strlen(words), module ? sizes[2] : 0};
        fwrite(reply, sizeof reply, 1, stdout);
        fwrite(words, 1, reply[0], stdout);
        if (module) run(module, (UINT)atoi(arguments[3]), input, sizes[1], sizes[2]);
        fflush(stdout);
        if (said) ID3D10Blob_Release(said);
        if (module) ID3D10Blob_Release(module);
        free(text);
        free(input);
    }
    return 0;
}
