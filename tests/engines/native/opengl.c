/* Runs an emitted header (-DHEADER=...) as its README says, on EGL without a display: pictures of floats in, one out, rows from
   below. Usage: opengl WIDTH HEIGHT OUT [sampler=FILE,FILE... | uniform:NAME=VALUE]...
   -DVERTEX, -DFRAGMENT and -DSAMPLERS are the names of the header's texts and its table. */

#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include HEADER

static void fail(const char *what, const char *why) {
    fprintf(stderr, "%s: %s\n", what, why);
    exit(1);
}

static GLuint compile(GLenum kind, const char *text) {
    GLuint shader = glCreateShader(kind);
    GLint compiled = 0;
    char said[4096] = "";
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    glGetShaderInfoLog(shader, sizeof said, NULL, said);
    if (!compiled) fail("the shader does not compile", said);
    return shader;
}

static void context(void) {
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    EGLint found = 0;
    EGLConfig config;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    if (!eglInitialize(display, NULL, NULL)) fail("EGL", "no display");
    if (!eglBindAPI(EGL_OPENGL_API)) fail("EGL", "no OpenGL");
    if (!eglChooseConfig(display, wanted, &config, 1, &found) || !found) fail("EGL", "no configuration");
    EGLContext made = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    if (!made || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, made)) fail("EGL", "no context of OpenGL 3.3");
}

int main(int count, char **arguments) {
    if (count < 4) fail(arguments[0], "WIDTH HEIGHT OUT and what is read");
    const int width = atoi(arguments[1]), height = atoi(arguments[2]);
    const size_t texels = (size_t)width * height * 4;
    context();
    GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, VERTEX));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, FRAGMENT));
    glLinkProgram(program);
    glUseProgram(program);
    for (int unit = 0; SAMPLERS[unit].name; unit++) {
        const char *given = NULL;
        for (int k = 4; k < count; k++) {
            size_t length = strlen(SAMPLERS[unit].name);
            if (!strncmp(arguments[k], SAMPLERS[unit].name, length) && arguments[k][length] == '=') given = arguments[k] + length + 1;
        }
        if (!given) fail(SAMPLERS[unit].name, "is not given");
        char *files = malloc(strlen(given) + 1);
        strcpy(files, given);
        int layers = 0;
        float *data = NULL;
        for (char *file = strtok(files, ","); file; file = strtok(NULL, ",")) {
            FILE *open = fopen(file, "rb");
            data = realloc(data, (layers + 1) * texels * sizeof(float));
            if (!open || fread(data + layers * texels, sizeof(float), texels, open) != texels) fail(file, "cannot be read");
            fclose(open);
            layers++;
        }
        const GLenum target = strstr(SAMPLERS[unit].type, "Array") ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
        const GLint filter = strcmp(SAMPLERS[unit].filter, "nearest") ? GL_LINEAR : GL_NEAREST;
        GLuint texture;
        glGenTextures(1, &texture);
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(target, texture);
        if (target == GL_TEXTURE_2D) glTexImage2D(target, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, data);
        else glTexImage3D(target, 0, GL_RGBA32F, width, height, layers, 0, GL_RGBA, GL_FLOAT, data);
        glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
        glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
        glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glUniform1i(glGetUniformLocation(program, SAMPLERS[unit].name), unit);
    }
    for (int k = 4; k < count; k++) {
        char *value = strncmp(arguments[k], "uniform:", 8) ? NULL : strchr(arguments[k], '=');
        if (!value) continue;
        *value = 0;
        glUniform1f(glGetUniformLocation(program, arguments[k] + 8), (float)atof(value + 1));
    }
    GLuint target, framebuffer, vertices;
    glGenTextures(1, &target);
    glActiveTexture(GL_TEXTURE15);
    glBindTexture(GL_TEXTURE_2D, target);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, NULL);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glViewport(0, 0, width, height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    float *picture = malloc(texels * sizeof(float));
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, picture);
    if (glGetError()) fail("OpenGL", "reports an error");
    FILE *out = fopen(arguments[3], "wb");
    if (!out || fwrite(picture, sizeof(float), texels, out) != texels || fclose(out)) fail(arguments[3], "cannot be written");
    return 0;
}
