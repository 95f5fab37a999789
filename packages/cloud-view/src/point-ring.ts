/** The ring of vertices on the GPU: 4 int16 per point, as received. Written in ranges, never copied on the CPU. */
import { GLBufferAttribute, IntType } from 'three';
import type { Relocation } from './frame-window.ts';

/** A point on the GPU: four 16-bit integers (docs/drawing.md). */
const VERTEX_BYTES = 8;
const VERTEX_COMPONENTS = 4;

export class PointRing {
  /**
   * Called with a new `ivec4` vertex attribute when the buffer changes: three caches the binding of an attribute, so a
   * new buffer needs a new attribute.
   */
  readonly #onAttribute: (attribute: GLBufferAttribute) => void;
  readonly #gl: WebGL2RenderingContext;
  #buffer: WebGLBuffer;
  #capacity: number;

  constructor(
    gl: WebGL2RenderingContext,
    capacity: number,
    onAttribute: (attribute: GLBufferAttribute) => void,
  ) {
    this.#gl = gl;
    this.#capacity = capacity;
    this.#onAttribute = onAttribute;
    this.#buffer = this.#create(capacity);
    this.#publish();
  }

  /** Writes `count` points from `points`, beginning with point `first`, to vertex `vertex`. */
  write(points: Int16Array, first: number, count: number, vertex: number): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffer);
    gl.bufferSubData(
      gl.ARRAY_BUFFER,
      vertex * VERTEX_BYTES,
      points,
      first * VERTEX_COMPONENTS,
      count * VERTEX_COMPONENTS,
    );
  }

  /** Moves the live part to the front, GPU to GPU. */
  relocate({ from, count, capacity }: Relocation): void {
    const gl = this.#gl;
    const source = this.#buffer;
    if (capacity !== this.#capacity) {
      this.#buffer = this.#create(capacity);
      this.#capacity = capacity;
    }
    if (count > 0) {
      gl.bindBuffer(gl.COPY_READ_BUFFER, source);
      gl.bindBuffer(gl.COPY_WRITE_BUFFER, this.#buffer);
      gl.copyBufferSubData(
        gl.COPY_READ_BUFFER,
        gl.COPY_WRITE_BUFFER,
        from * VERTEX_BYTES,
        0,
        count * VERTEX_BYTES,
      );
      gl.bindBuffer(gl.COPY_READ_BUFFER, null);
      gl.bindBuffer(gl.COPY_WRITE_BUFFER, null);
    }
    if (source !== this.#buffer) {
      gl.deleteBuffer(source);
      this.#publish();
    }
  }

  /** Creates everything again after the GPU context was lost. */
  recreate(): void {
    this.#buffer = this.#create(this.#capacity);
    this.#publish();
  }

  dispose(): void {
    this.#gl.deleteBuffer(this.#buffer);
  }

  /** Reads points back, for tests. */
  read(vertex: number, into: Int16Array): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffer);
    gl.getBufferSubData(gl.ARRAY_BUFFER, vertex * VERTEX_BYTES, into);
  }

  #publish(): void {
    const { SHORT } = this.#gl;
    const attribute = new GLBufferAttribute(this.#buffer, SHORT, VERTEX_COMPONENTS, 2, this.#capacity);
    // Read by three's vertex setup (vertexAttribIPointer), though GLBufferAttribute does not declare it.
    Object.assign(attribute, { gpuType: IntType });
    this.#onAttribute(attribute);
  }

  #create(capacity: number): WebGLBuffer {
    const gl = this.#gl;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, capacity * VERTEX_BYTES, gl.STREAM_DRAW);
    return buffer;
  }
}
