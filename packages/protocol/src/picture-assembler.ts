/** Assembles pictures from their chunks, in any order of arrival. The newest picture of a camera wins. */
import {
  emptyPictureChunkHeader,
  MAX_CAMERAS,
  PICTURE_CHUNK_DATA_BYTES,
  PICTURE_CHUNK_HEADER_BYTES,
  type PictureChunkFault,
  type PictureChunkHeader,
  type PictureHeader,
  readPictureChunk,
} from './picture-chunk.ts';
import { sequenceDelta32 } from './sequence.ts';

/** Chunks of the next picture may overtake the last chunks of this one. */
const OPEN_PICTURES = 2;

/** Why a chunk, or an incomplete picture, was dropped. */
export type PictureDrop =
  | PictureChunkFault
  | 'unknown-camera' // the robot has not announced this camera
  | 'inconsistent' // its header contradicts earlier chunks of the picture
  | 'duplicate'
  | 'late' // the picture is no longer wanted: a newer one is complete, or it was dropped
  | 'superseded'; // the picture never became complete

export interface WholePicture extends PictureHeader {
  /** The file, JPEG or PNG as the header states. Its content has not been checked. */
  bytes: Uint8Array<ArrayBuffer>;
}

interface OpenPicture {
  header: PictureChunkHeader;
  bytes: Uint8Array<ArrayBuffer>;
  there: Uint8Array;
  missing: number;
  length: number;
}

interface Camera {
  /** Oldest first. */
  open: OpenPicture[];
  /** The newest picture that was returned or dropped. */
  doneId: number | null;
}

/** For one session. Holds at most two unfinished pictures per camera: 10 MB in total. */
export class PictureAssembler {
  /** How many cameras the robot has announced. */
  cameras = 0;
  readonly drops = new Map<PictureDrop, number>();
  readonly #cameras: Camera[] = Array.from({ length: MAX_CAMERAS }, () => ({ open: [], doneId: null }));
  readonly #header = emptyPictureChunkHeader();

  /** Takes one message. @returns the picture that it completes, else `null` */
  take(message: Uint8Array): WholePicture | null {
    const header = this.#header;
    const fault = readPictureChunk(
      new DataView(message.buffer, message.byteOffset, message.byteLength),
      header,
    );
    if (fault !== null) return this.#drop(fault);
    if (header.camera >= this.cameras) return this.#drop('unknown-camera');
    const camera = this.#cameras[header.camera] as Camera;
    if (camera.doneId !== null && sequenceDelta32(header.pictureId, camera.doneId) <= 0)
      return this.#drop('late');
    const picture = this.#find(camera, header);
    if (picture === null) return null;
    if (!agree(picture.header, header)) return this.#drop('inconsistent');
    if (picture.there[header.index] === 1) return this.#drop('duplicate');
    picture.there[header.index] = 1;
    const data = message.subarray(PICTURE_CHUNK_HEADER_BYTES);
    picture.bytes.set(data, header.index * PICTURE_CHUNK_DATA_BYTES);
    picture.length += data.length;
    picture.missing--;
    if (picture.missing > 0) return null;
    this.#finish(camera, header.pictureId);
    const { format, width, height, pictureId, captureTimeUs } = header;
    return {
      format,
      camera: header.camera,
      width,
      height,
      pictureId,
      captureTimeUs,
      bytes: picture.bytes.subarray(0, picture.length),
    };
  }

  /** Returns the picture of the chunk; the oldest makes room for a new one. `null` if the chunk is dropped. */
  #find(camera: Camera, header: PictureChunkHeader): OpenPicture | null {
    const { pictureId, count } = header;
    const found = camera.open.find((each) => each.header.pictureId === pictureId);
    if (found !== undefined) return found;
    if (camera.open.length === OPEN_PICTURES) {
      const [oldest] = camera.open as [OpenPicture];
      if (sequenceDelta32(pictureId, oldest.header.pictureId) <= 0) return this.#drop('late');
      this.#finish(camera, oldest.header.pictureId);
      this.#drop('superseded');
    }
    const picture: OpenPicture = {
      header: { ...header },
      bytes: new Uint8Array(count * PICTURE_CHUNK_DATA_BYTES),
      there: new Uint8Array(count),
      missing: count,
      length: 0,
    };
    camera.open.push(picture);
    camera.open.sort((a, b) => sequenceDelta32(a.header.pictureId, b.header.pictureId));
    return picture;
  }

  /** This picture is done, and earlier ones are no longer wanted. */
  #finish(camera: Camera, pictureId: number): void {
    camera.doneId = pictureId;
    const left = camera.open.filter((each) => sequenceDelta32(each.header.pictureId, pictureId) > 0);
    const older = camera.open.length - left.length - 1;
    if (older > 0) this.#drop('superseded', older);
    camera.open = left;
  }

  #drop(reason: PictureDrop, count = 1): null {
    this.drops.set(reason, (this.drops.get(reason) ?? 0) + count);
    return null;
  }
}

function agree(a: PictureChunkHeader, b: PictureChunkHeader): boolean {
  return (
    a.count === b.count &&
    a.format === b.format &&
    a.width === b.width &&
    a.height === b.height &&
    a.captureTimeUs === b.captureTimeUs
  );
}
