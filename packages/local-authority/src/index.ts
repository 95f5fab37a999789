export {
  type Authority,
  AuthorityError,
  type IssuedCertificate,
  issueCertificate,
  makeAuthority,
} from './authority.ts';
export { openAuthority } from './authority-folder.ts';
export { isLocalHost, type LocalAddress, localAddresses, type NetworkInterfaces } from './local-addresses.ts';
