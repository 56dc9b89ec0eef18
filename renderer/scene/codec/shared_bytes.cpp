#include "renderer/scene/codec/shared_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <new>
#include <utility>

namespace cutis {

namespace {

int anonymousFile() {
    return ::memfd_create("cutis pixels", MFD_CLOEXEC | MFD_ALLOW_SEALING);
}

}  // namespace

SharedBytes::SharedBytes(std::uint64_t size) : size_(size) {
    if (size == 0) return;
    descriptor_ = anonymousFile();
    if (descriptor_ >= 0 && ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0)
        map(PROT_READ | PROT_WRITE);
    if (!data_) {
        if (descriptor_ >= 0) ::close(descriptor_);
        throw std::bad_alloc();
    }
}

SharedBytes SharedBytes::file() {
    SharedBytes shared;
    shared.descriptor_ = anonymousFile();
    if (shared.descriptor_ < 0) throw std::bad_alloc();
    return shared;
}

std::string SharedBytes::path() const {
    return "/proc/self/fd/" + std::to_string(descriptor_);
}

std::uint64_t SharedBytes::sizeNow() const {
    struct stat status {};
    return ::fstat(descriptor_, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

SharedBytes SharedBytes::adopt(int descriptor, std::uint64_t size) {
    SharedBytes shared;
    shared.descriptor_ = descriptor;
    struct stat status {};
    // A mapping beyond the end of a file that shrinks is a bus error.
    if (size > 0 && ::fcntl(descriptor, F_ADD_SEALS, F_SEAL_SHRINK) == 0 &&
        ::fstat(descriptor, &status) == 0 && static_cast<std::uint64_t>(status.st_size) >= size) {
        shared.size_ = size;
        shared.map(PROT_READ);
    }
    return shared;
}

void SharedBytes::map(int protection) {
    void* mapped = ::mmap(nullptr, size_, protection, MAP_SHARED, descriptor_, 0);
    if (mapped == MAP_FAILED) {
        size_ = 0;
    } else {
        data_ = static_cast<std::byte*>(mapped);
    }
}

SharedBytes::~SharedBytes() {
    if (data_) ::munmap(data_, size_);
    if (descriptor_ >= 0) ::close(descriptor_);
}

SharedBytes& SharedBytes::operator=(SharedBytes&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

}  // namespace cutis
