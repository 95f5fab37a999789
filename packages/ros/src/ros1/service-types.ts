/** The services that a robot calls: those of std_srvs, which ask for no more than a yes or no. */
import { RosFault } from '../fault.ts';
import type { ServiceReply, ServiceType } from '../std-services.ts';

/** MD5 of the service’s definition, by which both sides know that they mean the same. */
export const SERVICE_SUMS: Readonly<Record<ServiceType, string>> = {
  'std_srvs/Empty': 'd41d8cd98f00b204e9800998ecf8427e',
  'std_srvs/Trigger': '937c9679a518e3a18d831e57125ea522',
  'std_srvs/SetBool': '09fb03525b03e7ea1fd3992bafd87e16',
};

/** @param data of SetBool */
export function serviceRequest(type: ServiceType, data: boolean): Uint8Array {
  return type === 'std_srvs/SetBool' ? Uint8Array.of(data ? 1 : 0) : new Uint8Array();
}

/** @throws {RosFault} `bad-message` */
export function readServiceReply(type: ServiceType, bytes: Uint8Array): ServiceReply {
  if (type === 'std_srvs/Empty') {
    if (bytes.length !== 0) throw new RosFault('bad-message', `an answer of ${bytes.length} bytes, not 0`);
    return { success: true, message: '' };
  }
  const [success] = bytes;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 5 || view.getUint32(1, true) !== bytes.length - 5)
    throw new RosFault('bad-message', `an answer of ${bytes.length} bytes that is none of ${type}`);
  return { success: success === 1, message: new TextDecoder().decode(bytes.subarray(5)) };
}
