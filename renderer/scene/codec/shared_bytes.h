// Memory that two processes see.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace cutis {

// An anonymous file, mapped. Pages that nobody wrote take no memory.
class SharedBytes {
  public:
    SharedBytes() = default;
    // Of zeros. Throws std::bad_alloc.
    explicit SharedBytes(std::uint64_t size);
    // An empty one, for a library that writes files: it opens path(). sizeNow() tells how much it wrote.
    static SharedBytes file();
    std::string path() const;
    std::uint64_t sizeNow() const;
    // Takes over a file of another process, which can no longer shrink it. Empty when it has fewer bytes than
    // `size`.
    static SharedBytes adopt(int descriptor, std::uint64_t size);
    ~SharedBytes();
    SharedBytes(SharedBytes&& other) noexcept { *this = static_cast<SharedBytes&&>(other); }
    SharedBytes& operator=(SharedBytes&& other) noexcept;

    int descriptor() const { return descriptor_; }
    std::byte* data() { return data_; }
    std::span<const std::byte> bytes() const { return {data_, size_}; }
    bool empty() const { return size_ == 0; }

  private:
    void map(int protection);

    int descriptor_ = -1;
    std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace cutis
